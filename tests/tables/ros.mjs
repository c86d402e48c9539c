// Reads what glint-mcap --ros2 writes as ROS 2 does: MCAP by @mcap/core, messages by @foxglove's readers, with the
// definitions in the file and with those of ROS 2 itself. Every number of every message is compared with the lines.
// Usage: tests/tables/run BIN_DIR
import fs from 'node:fs';
import {execFileSync} from 'node:child_process';
import {parse} from '@foxglove/rosmsg';
import {MessageReader, MessageWriter} from '@foxglove/rosmsg2-serialization';
import * as distributions from '@foxglove/rosmsg-msgs-common';
import {byIndex, check, checkStream, end} from './files.mjs';

const work = process.argv[2];
const CHAIN = 'glint-extract | glint-ideal --effects all --sensors';
// A radar that measures elevation, and scenes with ghosts, with clutter, and with scans that lack targets or are not made.
const ELEVATED = {extends: 'lrr77-full', origin: 'for tests', sensors: [{name: 'front', elevation_view_rad: 0.3,
    elevation_sigma_rad: 0.02}]};
const STREAMS = {'walled-road': 'radarscenes77-full', 'intersection': 'radarscenes77-full', 'wet-road': `${work}/elevated.json`,
    'two-vehicles': 'corner77'};
const PATHS = ['direct', 'wall_object', 'object_wall', 'wall_object_wall', 'wheel', 'limb', 'clutter', 'false_alarm'];
const FLOAT32 = 7, UINT32 = 6, CUBE = 1, TEXT = 9, ADD = 0, DELETEALL = 3;

// A field of a point, and where the lines have its value.
const VALUES = {
    radial_speed: one => one.range_rate_mps, power: one => one.amplitude_db, rcs: one => one.quality.rcs_dbsm,
    snr: one => one.quality.snr_db, elevation_angle: one => one.elevation_rad,
    range: one => one.range_m, range_std: one => one.quality.range_sd_m, azimuth_std: one => one.quality.azimuth_sd_rad,
    elevation_std: one => one.quality.elevation_sd_rad, range_rate_std: one => one.quality.range_rate_sd_mps,
    ground_relative_radial_velocity: one => one.quality.range_rate_over_ground_mps,
    path: one => PATHS.indexOf(strongest(one).path), contributors: one => one.contributors.length,
};
const OTHER_FIELDS = ['x', 'y', 'z', 'azimuth_angle', 'object'];

function strongest(target) {
    return target.contributors.reduce((a, b) => b.weight > a.weight ? b : a);
}

function near(found, wanted, close, text) {
    check(Math.abs(found - wanted) <= close, `${text} is ${found}, not ${wanted}`);
}

function make(scenario, suite) {
    fs.writeFileSync(`${work}/elevated.json`, JSON.stringify(ELEVATED));
    execFileSync('glint', ['-c', `glint-traffic ${scenario} --sections quality,objects | ${CHAIN} ${suite} | glint-sensor | ` +
        `glint-noise -o ${work}/ros.jsonl`]);
    execFileSync('glint-mcap', ['--ros2', `${work}/ros.jsonl`, '-o', `${work}/ros.mcap`]);
    return fs.readFileSync(`${work}/ros.jsonl`, 'utf8').trimEnd().split('\n').map(JSON.parse);
}

// The messages of each topic, decoded; what each distribution of ROS 2 decodes is the same, and another writer of CDR
// gives them the same bytes.
function decode({topics, schemas, channels}) {
    const found = {};
    for (const [topic, messages] of Object.entries(topics)) {
        const {name, encoding, data} = schemas[topic];
        check(encoding === 'ros2msg' && channels[topic].messageEncoding === 'cdr', `${topic}: ${encoding}`);
        check(channels[topic].metadata.has('offered_qos_profiles'), `${topic}: its quality of service`);
        check(/^(\/[A-Za-z_][A-Za-z0-9_]*)+$/.test(topic), `${topic} is no topic of ROS 2`);
        const definitions = parse(Buffer.from(data).toString(), {ros2: true});
        const reader = new MessageReader(definitions), writer = new MessageWriter(definitions);
        const own = messages.map(message => reader.readMessage(message.data));
        messages.forEach((message, i) => check(Buffer.compare(writer.writeMessage(own[i]), message.data) === 0,
            `the bytes of message ${i} of ${topic}`));
        for (const distribution of ['ros2humble', 'ros2iron', 'ros2jazzy']) {
            const known = distributions[distribution], type = name.replace('/msg/', '/');
            const foreign = new MessageReader([known[type], ...Object.values(known).filter(one => one.name !== type)]);
            messages.forEach((message, i) => check(text(foreign.readMessage(message.data)) === text(own[i]),
                `${distribution}: message ${i} of ${topic}`));
        }
        found[topic] = messages.map((message, i) => ({time: message.logTime, ...own[i]}));
    }
    return found;
}

function text(message) {
    return JSON.stringify(message, (_, value) => ArrayBuffer.isView(value) ? Array.from(value, String) : value);
}

function nanoseconds({sec, nanosec}) {
    check(nanosec < 1e9 && sec >= 1, `a stamp of ${sec} s and ${nanosec} ns`);
    return BigInt(sec) * 1000000000n + BigInt(nanosec);
}

function points(cloud) {
    const {fields, data, point_step: step, width} = cloud, view = new DataView(data.buffer, data.byteOffset, data.length);
    check(cloud.height === 1 && !cloud.is_bigendian && data.length === step * width && cloud.row_step === data.length, 'sizes');
    fields.forEach((field, i) => check(field.offset === 4 * i && field.count === 1 && [FLOAT32, UINT32].includes(field.datatype),
        `field ${field.name}`));
    return Array.from({length: width}, (_, i) => Object.fromEntries(fields.map(({name, offset, datatype}) =>
        [name, datatype === FLOAT32 ? view.getFloat32(i * step + offset, true) : view.getUint32(i * step + offset, true)])));
}

// ---- coordinates, as tf2 has them -------------------------------------------------------------------------------

function yaw({z, w}) {
    return 2 * Math.atan2(z, w);
}

// The pose of a system of coordinates in its parent, between its stamps before and after.
function lookup(chain, time) {
    const after = chain.findIndex(one => one.stamp >= time);
    check(after === 0 ? chain[0].stamp === time : after > 0, `no transform at ${time} ns`);
    const [a, b] = [chain[Math.max(after - 1, 0)], chain[after]];
    const share = a.stamp === b.stamp ? 1 : Number(time - a.stamp) / Number(b.stamp - a.stamp);
    const mix = (from, to) => from + share * (to - from);
    const turn = Math.atan2(Math.sin(b.yaw - a.yaw), Math.cos(b.yaw - a.yaw));
    return {x: mix(a.x, b.x), y: mix(a.y, b.y), z: mix(a.z, b.z), yaw: a.yaw + share * turn};
}

function placed({x, y, z}, pose) {
    return {x: pose.x + x * Math.cos(pose.yaw) - y * Math.sin(pose.yaw),
        y: pose.y + x * Math.sin(pose.yaw) + y * Math.cos(pose.yaw), z: pose.z + z};
}

function chains(messages) {
    const found = {};
    for (const {transforms} of messages)
        for (const one of transforms) {
            const {translation: place, rotation} = one.transform, chain = found[one.child_frame_id] ??= [];
            const stamp = nanoseconds(one.header.stamp);
            check(one.header.frame_id === (one.child_frame_id === 'base_link' ? 'map' : 'base_link'), 'its parent');
            near(Math.hypot(rotation.x, rotation.y, rotation.z, rotation.w), 1, 1e-15, 'the norm of a quaternion');
            chain.push({stamp, ...place, yaw: yaw(rotation)});
        }
    for (const [name, chain] of Object.entries(found)) {
        chain.sort((a, b) => a.stamp < b.stamp ? -1 : 1);
        check(chain.every((one, i) => i === 0 || one.stamp > chain[i - 1].stamp), `${name}: no stamp comes twice`);
    }
    return found;
}

// ---- comparisons with the lines ---------------------------------------------------------------------------------

let compared = 0, empty = 0, elevated = 0, missing = 0;

function checkPoint(point, target, numbers) {
    for (const [name, value] of Object.entries(VALUES)) {
        const wanted = value(target);
        check(wanted === undefined ? Number.isNaN(point[name]) : point[name] === Math.fround(wanted), `${name}: ${point[name]}, not ${wanted}`);
        compared++;
    }
    const {object, path} = strongest(target), none = ['clutter', 'false_alarm'].includes(path);
    check(none ? point.object === 0 : numbers.get(point.object) === object, `object ${point.object}: ${object}`);
    near(Math.hypot(point.x, point.y, point.z), target.range_m, 1e-5 * target.range_m, 'the length of a point');
    near(point.z, target.range_m * Math.sin(target.elevation_rad ?? 0), 1e-5 * target.range_m, 'z');
    near(point.azimuth_angle, Math.atan2(point.y, point.x), 1e-6, 'azimuth_angle');
    near(point.y, target.range_m * Math.sin(target.azimuth_rad), 1e-5 * target.range_m, 'y');
}

// The place of a scan is exact in single precision, of the world's in 0.1 mm: at its stamp there is a transform.
function checkPlace(point, cloud, target, tf) {
    const time = nanoseconds(cloud.header.stamp);
    const place = placed(placed(point, lookup(tf[cloud.header.frame_id], time)), lookup(tf.base_link, time));
    near(place.x, target.quality.x_world_m, 2e-4, 'x in map');
    near(place.y, target.quality.y_world_m, 2e-4, 'y in map');
}

function checkClouds(messages, frames, shift_s, tf) {
    const waiting = new Map(Object.entries(messages).filter(([topic]) => topic.startsWith('/radar/'))
        .map(([topic, clouds]) => [topic, clouds.values()]));
    frames.forEach((frame, i) => {
        const numbers = new Map(messages['/objects'][i].markers.filter(one => one.type === TEXT)
            .map(one => [one.id, one.text.slice(0, one.text.lastIndexOf(' ('))]));
        missing += frame.sensors.list.filter(one => !one.measured).length;
        for (const sensor of frame.sensors.list.filter(one => one.measured)) {
            const cloud = waiting.get(`/radar/${sensor.name}`).next().value;
            const targets = frame.targets.filter(one => one.sensor === sensor.name), found = points(cloud);
            empty += targets.length === 0;
            elevated += targets.filter(one => one.elevation_rad).length;
            near(Number(cloud.time) * 1e-9, frame.time_s + shift_s, 1e-9, 'the time of a message');
            near(Number(nanoseconds(cloud.header.stamp)) * 1e-9, frame.time_s + shift_s - (sensor.age_s ?? 0), 1e-9, 'a stamp');
            check(cloud.header.frame_id === `radar_${sensor.name}` && found.length === targets.length, `${found.length} points`);
            check(cloud.is_dense === found.every(one => Object.values(one).every(Number.isFinite)), 'is_dense');
            check(cloud.fields.length === Object.keys(VALUES).length + OTHER_FIELDS.length, 'no other fields');
            found.forEach((point, k) => {
                checkPoint(point, targets[k], numbers);
                checkPlace(point, cloud, targets[k], tf);
            });
        }
    });
    for (const [topic, clouds] of waiting)
        check(clouds.next().done, `a cloud of ${topic} for each scan`);
}

function checkBoxes(messages, frames, shift_s) {
    check(messages.length === frames.length, 'boxes of each frame');
    messages.forEach(({time, markers}, i) => {
        const [first, ...others] = markers, {objects} = frames[i];
        check(first.action === DELETEALL && others.length === 2 * objects.length, 'markers replace all others');
        near(Number(time) * 1e-9, frames[i].time_s + shift_s, 1e-9, 'the time of boxes');
        objects.forEach((object, k) => {
            const [box, label] = others.slice(2 * k);
            const {position: place, orientation} = box.pose, size = box.scale;
            check(box.type === CUBE && label.type === TEXT && box.action === ADD && label.action === ADD, 'kinds of markers');
            check(box.ns === 'boxes' && label.ns === 'labels' && box.id === label.id && box.id > 0, 'ids of markers');
            check(label.text === `${object.id} (${object.class})`, label.text);
            check(place.x === object.x_m && place.y === object.y_m && 2 * place.z === object.height_m, `the place of ${object.id}`);
            check(size.x === object.length_m && size.y === object.width_m && size.z === object.height_m, `the size of ${object.id}`);
            near(Math.cos(yaw(orientation) - object.yaw_rad), 1, 1e-15, `the yaw of ${object.id}`);
            check(label.pose.position.z > object.height_m && label.scale.z > 0 && label.color.a === 1 && box.color.a > 0, 'a text over it');
            for (const one of [box, label]) {
                check(one.header.frame_id === 'map' && nanoseconds(one.header.stamp) === time && !one.frame_locked, 'its header');
                check(one.lifetime.sec === 0 && one.lifetime.nanosec === 0 && one.points.length === 0 && one.mesh_resource === '', 'the rest');
            }
        });
    });
}

function checkEgo(tf, frames, shift_s) {
    frames.forEach(frame => {
        const ego = frame.objects.find(one => one.id === frame.ego);
        const pose = lookup(tf.base_link, BigInt(Math.round((frame.time_s + shift_s) * 1e9)));
        near(Math.hypot(pose.x - ego.x_m, pose.y - ego.y_m), 1.25, 0.01, 'from the centre to the rear axle');
        near(Math.cos(pose.yaw - ego.yaw_rad), 1, 1e-12, 'the yaw of base_link');
        for (const sensor of frame.sensors.list) {
            const mount = tf[`radar_${sensor.name}`][0];
            near(mount.x - (sensor.mount_x_m + 1.25), 0, 0.01, 'a mount');
            check(mount.y === sensor.mount_y_m && mount.z === (sensor.mount_z_m ?? 0), 'a mount');
            near(mount.yaw, sensor.mount_yaw_rad, 1e-12, 'the yaw of a mount');
        }
    });
}

for (const [scenario, suite] of Object.entries(STREAMS)) {
    const frames = make(scenario, suite);
    const bytes = new Uint8Array(fs.readFileSync(`${work}/ros.mcap`));
    const file = await byIndex(bytes);
    check(file.profile === 'ros2', `profile ${file.profile}`);
    checkStream(bytes, file.topics);
    const messages = decode(file), tf = chains(messages['/tf']);
    const shift_s = Number(messages['/objects'][0].time) * 1e-9 - frames[0].time_s;
    checkBoxes(messages['/objects'], frames, shift_s);
    checkEgo(tf, frames, shift_s);
    checkClouds(messages, frames, shift_s, tf);
    console.log(`@foxglove/rosmsg2-serialization reads ${frames.length} frames of ${scenario} in ${
        Object.entries(file.topics).map(([topic, those]) => `${those.length} of ${topic}`).join(', ')}`);
}
check(empty > 0 && elevated > 0 && missing > 0, 'the streams have all kinds of scans and points');
console.log(`${compared} values of points are those of the lines, in ${empty} empty clouds, ${elevated} points with a height and ${
    missing} scans that were not made`);
end();
