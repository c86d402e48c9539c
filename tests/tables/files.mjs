// Files of MCAP, read by @mcap/core: by their index, and as a stream.
import {McapIndexedReader, McapStreamReader} from '@mcap/core';

let faults = 0;

export function check(good, text) {
    if (good)
        return;
    console.log(`FAILED   ${text}`);
    if (++faults === 10)
        process.exit(1);
}

export function end() {
    process.exit(faults > 0 ? 1 : 0);
}

// The messages of each topic, their schemas and channels, by the index.
export async function byIndex(bytes) {
    const readable = {size: async () => BigInt(bytes.length),
        read: async (offset, size) => new Uint8Array(bytes.subarray(Number(offset), Number(offset + size)))};
    const reader = await McapIndexedReader.Initialize({readable});
    const topics = {}, schemas = {}, channels = {};
    for (const channel of reader.channelsById.values()) {
        topics[channel.topic] = [];
        schemas[channel.topic] = reader.schemasById.get(channel.schemaId);
        channels[channel.topic] = channel;
    }
    for await (const message of reader.readMessages())
        topics[reader.channelsById.get(message.channelId).topic].push(message);
    for (const [id, count] of reader.statistics.channelMessageCounts)
        check(topics[reader.channelsById.get(id).topic].length === Number(count), `statistics of channel ${id}`);
    return {topics, schemas, channels, profile: reader.header.profile, chunks: reader.chunkIndexes.length};
}

export function byStream(bytes) {
    const reader = new McapStreamReader({validateCrcs: true}), messages = [];
    for (let at = 0; at < bytes.length; at += 10000) {
        reader.append(bytes.subarray(at, at + 10000));
        for (let record = reader.nextRecord(); record; record = reader.nextRecord())
            if (record.type === 'Message')
                messages.push(record);
    }
    check(reader.done(), 'the stream has an end');
    return messages;
}

export function checkStream(bytes, topics) {
    const streamed = byStream(bytes).map(one => Buffer.from(one.data).toString('base64')).sort();
    const indexed = Object.values(topics).flat().map(one => Buffer.from(one.data).toString('base64')).sort();
    check(JSON.stringify(streamed) === JSON.stringify(indexed), 'the stream has the messages of the index');
    const damaged = new Uint8Array(bytes);
    damaged[bytes.length >> 1] ^= 1;
    let found = false;
    try {
        byStream(damaged);
    } catch {
        found = true;
    }
    check(found, 'a damaged byte is found by its checksum');
}
