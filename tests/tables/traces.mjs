// Reads what glint-mcap and glint-osi write with other people's libraries: MCAP by its index and as a stream, messages
// of Foxglove by their published schemas, messages of OSI by the descriptors in the file. Usage: tests/tables/run BIN_DIR
import fs from 'node:fs';
import {execFileSync} from 'node:child_process';
import Ajv from 'ajv';
import Ajv2020 from 'ajv/dist/2020.js';
import protobuf from 'protobufjs';
import 'protobufjs/ext/descriptor/index.js';
import * as published from '@foxglove/schemas/jsonschema.js';
import {byIndex, check, checkStream, end} from './files.mjs';

const work = process.argv[2];
const CHAIN = 'glint-extract | glint-ideal --sensors radarscenes77-full --effects all | glint-sensor | glint-noise';
function make() {
    const commands = `glint-traffic walled-road --sections quality,objects | ${CHAIN} -o ${work}/lines.jsonl`;
    execFileSync('glint', ['-c', commands]);
    for (const format of ['mcap', 'osi'])
        execFileSync(`glint-${format}`, ['--shift-s', '1', `${work}/lines.jsonl`, '-o', `${work}/trace.${format}`]);
    return fs.readFileSync(`${work}/lines.jsonl`, 'utf8').trimEnd().split('\n').map(JSON.parse);
}

function checkJson({topics, schemas}, frames) {
    const ajv = new Ajv({strict: false}), ajv2020 = new Ajv2020({strict: false});
    for (const [topic, schema] of Object.entries(schemas)) {
        if (schema.encoding !== 'jsonschema')
            continue;
        const own = JSON.parse(Buffer.from(schema.data).toString());
        const validators = [own.$schema ? ajv2020.compile(own) : ajv.compile(own)];
        if (schema.name.startsWith('foxglove.'))
            validators.push(ajv.compile(published[schema.name.slice('foxglove.'.length)]));
        for (const message of topics[topic])
            for (const valid of validators)
                check(valid(JSON.parse(Buffer.from(message.data).toString())), `${topic}: ${JSON.stringify(valid.errors)}`);
    }
    check(topics['/frames'].every((one, i) => JSON.stringify(JSON.parse(Buffer.from(one.data).toString())) ===
        JSON.stringify(frames[i])), 'frames are the lines');
}

function checkMessage(data, frame) {
    const names = new Map();
    for (const list of ['movingObject', 'stationaryObject'])
        for (const one of data.sensorView[0].globalGroundTruth[list] ?? []) {
            const object = frame.objects.find(other => other.id === one.sourceReference[0].identifier[0]);
            names.set(one.id.value, object.id);
            check(one.base.position.x === object.x_m && one.base.position.y === object.y_m &&
                one.base.orientation.yaw === object.yaw_rad && one.base.dimension.height === object.height_m,
            `the pose of ${object.id}`);
        }
    check(names.size === frame.objects.length, 'all objects are there');
    const detections = (data.featureData.radarSensor ?? []).flatMap(radar => radar.detection ?? []);
    check(detections.length === frame.targets.length, 'all targets are there');
    detections.forEach((one, i) => {
        const target = frame.targets[i];
        check(one.position.distance === target.range_m && one.position.azimuth === target.azimuth_rad &&
            one.radialVelocity === 0 - target.range_rate_mps && one.snr === target.quality.snr_db, `detection ${i}`);
    });
}

function checkOsi({topics, schemas}, frames) {
    const schema = schemas['/osi/SensorData'];
    check(schema.name === 'osi3.SensorData' && schema.encoding === 'protobuf', 'the schema of OSI');
    const type = protobuf.Root.fromDescriptor(schema.data).lookupType(schema.name);
    const decoded = bytes => type.toObject(type.decode(bytes), {longs: String});
    const trace = fs.readFileSync(`${work}/trace.osi`);
    let at = 0;
    topics['/osi/SensorData'].forEach((message, i) => {
        const data = decoded(message.data);
        const length = trace.readUInt32LE(at);
        check(JSON.stringify(decoded(trace.subarray(at + 4, at + 4 + length))) === JSON.stringify(data), 'the trace has the same');
        at += 4 + length;
        check(message.logTime === BigInt(data.timestamp.seconds) * 1000000000n + BigInt(data.timestamp.nanos ?? 0), 'its time');
        checkMessage(data, frames[i]);
    });
    check(at === trace.length && topics['/osi/SensorData'].length === frames.length, 'all messages are there');
}

const frames = make();
const bytes = new Uint8Array(fs.readFileSync(`${work}/trace.mcap`));
const file = await byIndex(bytes);
check(file.chunks > 1, 'the file has several chunks');
checkStream(bytes, file.topics);
checkJson(file, frames);
checkOsi(file, frames);
console.log(`@mcap/core, @foxglove/schemas and protobufjs read ${frames.length} frames in ${
    Object.entries(file.topics).map(([topic, messages]) => `${messages.length} of ${topic}`).join(', ')}`);
end();
