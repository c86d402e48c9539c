// The frames: columns of typed arrays, decoded from base64 when they are first used. A row of one
// table owns rows of another by count; starts(name) adds the counts up to row numbers.

const rightToLeft = /[\u0590-\u08ff\ufb1d-\ufdff\ufe70-\ufefc]/;

// A name as the page shows it: marks that turn the direction of writing are made visible, and a name
// in letters that run from right to left turns nothing around it.
function shownName(name) {
    const plain = name.replace(/[\u200e\u200f\u061c\u202a-\u202e\u2066-\u2069]/g, '\ufffd');
    return rightToLeft.test(plain) ? `\u2068${plain}\u2069` : plain;
}

const head = JSON.parse(document.getElementById('head').textContent,
    (_, value) => typeof value === 'string' ? shownName(value) : value);
const base64 = document.getElementById('columns').firstChild.data;
const base64Begin = base64.search(/[^\s]/);
const names = head.names;
const places = new Map(head.columns.map(place => [place.name, place]));
const effectSets = head.effect_sets.map(set => set.effects.map(name => head.effects.indexOf(name)));
const decoded = new Map();
const summed = new Map();

const arrays = {f4: Float32Array, u1: Uint8Array, u2: Uint16Array, u4: Uint32Array};

function bytesOf(text) {
    if (Uint8Array.fromBase64) {
        return Uint8Array.fromBase64(text);
    }
    const binary = atob(text);
    const bytes = new Uint8Array(binary.length);
    for (let i = 0; i < bytes.length; i++) {
        bytes[i] = binary.charCodeAt(i);
    }
    return bytes;
}

function decode(place) {
    const array = arrays[place.type];
    const size = Math.ceil(place.count * array.BYTES_PER_ELEMENT / 12) * 16;
    const begin = base64Begin + place.begin;
    const bytes = bytesOf(base64.slice(begin, begin + size));
    return new array(bytes.buffer, 0, place.count);
}

function column(name) {
    let values = decoded.get(name);
    if (values === undefined) {
        values = decode(places.get(name));
        decoded.set(name, values);
    }
    return values;
}

// The first of the rows that each row owns, and one past the last.
function starts(name) {
    let sums = summed.get(name);
    if (sums === undefined) {
        const counts = column(name);
        sums = new Uint32Array(counts.length + 1);
        for (let i = 0; i < counts.length; i++) {
            sums[i + 1] = sums[i] + counts[i];
        }
        summed.set(name, sums);
    }
    return sums;
}

// The frames of each scene in order of time; streams may be interleaved or shuffled.
function framesByScene() {
    const scenes = head.scenes.map(() => []);
    const owner = column('frame_scene');
    for (let i = 0; i < owner.length; i++) {
        scenes[owner[i]].push(i);
    }
    const times = column('frame_time_s');
    scenes.forEach(frames => frames.sort((a, b) => times[a] - times[b]));
    return scenes;
}

// The number of a frame in its scene. The column has it relative to the scene's first line, as 32
// bits with a sign, because in a shuffled stream it may be negative.
function frameNumber(frame) {
    const scene = head.scenes[column('frame_scene')[frame]];
    return scene.first_frame + (column('frame_number')[frame] | 0);
}

const sceneFrames = framesByScene();
const hasObjects = column('frame_objects').some(count => count > 0);

// The index of a scene's last frame that is not later than a time, by bisection.
function rowAt(frames, time) {
    const times = column('frame_time_s');
    let low = 0;
    let high = frames.length - 1;
    while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (times[frames[middle]] <= time) {
            low = middle;
        } else {
            high = middle - 1;
        }
    }
    return low;
}

// The whole numbers from begin to the one before end.
function numbersIn({begin, end}) {
    return Array.from({length: end - begin}, (_, i) => begin + i);
}

function objectsOf(frame) {
    const begin = starts('frame_objects');
    return {begin: begin[frame], end: begin[frame + 1]};
}

function scansOf(frame) {
    const begin = starts('frame_scans');
    return {begin: begin[frame], end: begin[frame + 1]};
}

function targetsOf(scan) {
    const begin = starts('scan_targets');
    return {begin: begin[scan], end: begin[scan + 1]};
}

function contributorsOf(target) {
    const begin = starts('target_contributors');
    return {begin: begin[target], end: begin[target + 1]};
}

// The row of the object with this id in a frame, or -1.
function objectRow(frame, id) {
    const ids = column('object_id');
    const {begin, end} = objectsOf(frame);
    for (let i = begin; i < end; i++) {
        if (ids[i] === id) {
            return i;
        }
    }
    return -1;
}

function sensorOf(scan) {
    return head.sensors[column('scan_sensor')[scan]];
}

// The full widths of a scan's resolution cell: an echo within half of them of a stronger one shares its
// cell. Null where the stream does not tell them.
function cellOf(scan) {
    const {resolution_range_m: range, resolution_range_rate_mps: rate} = sensorOf(scan);
    return range > 0 && rate > 0 ? {range_m: 2 * range, range_rate_mps: 2 * rate} : null;
}

// Sensors of the same name look alike in all scenes.
const sensorNames = [...new Set(head.sensors.map(sensor => sensor.name))].sort();

function sensorStyle(scan) {
    return sensorNames.indexOf(sensorOf(scan).name);
}

function scanOfSensor(frame, name) {
    return numbersIn(scansOf(frame)).find(scan => sensorOf(scan).name === name) ?? -1;
}

// A target belongs to the object of its leader, which opened the cell.
function leaderOf(target) {
    return contributorsOf(target).begin;
}

function objectOfTarget(target) {
    return column('contributor_object')[leaderOf(target)];
}

// The effects in a target's label, by number.
function effectsOf(target) {
    return effectSets[column('target_effects')[target]];
}

// The kind of a target by its leader: "body", "ghost", "clutter" or "false_alarm".
function kindOf(target) {
    return head.kinds[column('contributor_path')[leaderOf(target)]];
}

// Ghosts come by way of a mirror: nothing is where they are seen.
function isGhostPath(path) {
    return head.kinds[path] === 'ghost';
}

const interferenceEffect = head.effects.indexOf('interference');
const ambiguityEffect = head.effects.indexOf('ambiguity');

function isInterfered(target) {
    return effectsOf(target).includes(interferenceEffect);
}

// The exact value of a cell: the mean of its contributors' by their weights.
function exactValue(name, target) {
    const values = column('contributor_' + name);
    const weights = column('contributor_weight');
    const {begin, end} = contributorsOf(target);
    let sum = 0;
    let weight = 0;
    for (let i = begin; i < end; i++) {
        sum += weights[i] * values[i];
        weight += weights[i];
    }
    return weight > 0 ? sum / weight : values[begin];
}

// True if a value of a target is folded: the radar reports it as another by an ambiguity.
function isFolded(target, name, cell) {
    return effectsOf(target).includes(ambiguityEffect) &&
        Math.abs(column('target_' + name)[target] - exactValue(name, target)) > 2 * cell;
}

function isRateFolded(scan, target) {
    return isFolded(target, 'range_rate_mps', sensorOf(scan).cell_range_rate_mps);
}

function isRangeFolded(scan, target) {
    return isFolded(target, 'range_m', sensorOf(scan).cell_range_m);
}

function detailsOf(scan) {
    const begin = starts('scan_details');
    return {begin: begin[scan], end: begin[scan + 1]};
}

// The targets of a scan with contributors of an object: their rows and their numbers in the list.
function targetsFrom(scan, object) {
    const objects = column('contributor_object');
    const found = [];
    const {begin, end} = targetsOf(scan);
    for (let target = begin; target < end; target++) {
        const parts = contributorsOf(target);
        for (let i = parts.begin; i < parts.end; i++) {
            if (objects[i] === object) {
                found.push({target, number: target - begin + 1});
                break;
            }
        }
    }
    return found;
}

// The scan that a target belongs to, in its frame.
function scanOfTarget(frame, target) {
    return numbersIn(scansOf(frame)).find(scan => {
        const {begin, end} = targetsOf(scan);
        return target >= begin && target < end;
    }) ?? -1;
}

// An elevation of a target in words; '' if its sensor measures none.
function elevationOf(target, name, digits) {
    const [row, end] = starts('target_elevations').slice(target, target + 2);
    return row === end ? '' : `${round(column(name)[row] * degrees, digits)}°`;
}

// The range rate as reported, or compensated for the sensor's own motion. A compensated rate is null if
// the rate is folded, or if the stream has no ego.
function rateOf(scan, target, compensated) {
    const rate = column('target_range_rate_mps')[target];
    if (!compensated) {
        return rate;
    }
    if (isRateFolded(scan, target) || Number.isNaN(column('scan_vx_mps')[scan])) {
        return null;
    }
    const angle = column('scan_yaw_rad')[scan] + column('target_azimuth_rad')[target];
    return rate + column('scan_vx_mps')[scan] * Math.cos(angle) +
        column('scan_vy_mps')[scan] * Math.sin(angle);
}

// The largest range rate of all targets, over ground or as reported.
function fastestRate(compensated) {
    let fastest = 0;
    for (let scan = 0; scan < column('scan_targets').length; scan++) {
        const {begin, end} = targetsOf(scan);
        for (let target = begin; target < end; target++) {
            fastest = Math.max(fastest, Math.abs(rateOf(scan, target, compensated) || 0));
        }
    }
    return fastest;
}

// The number of frames missing between a scene's first and last.
function framesMissing(number) {
    const present = new Set(sceneFrames[number].map(frameNumber));
    let low = Infinity;
    let high = -Infinity;
    for (const frame of present) {
        low = Math.min(low, frame);
        high = Math.max(high, frame);
    }
    return high - low + 1 - present.size;
}

function extremes(name, absolute) {
    let low = Infinity;
    let high = -Infinity;
    for (const value of column(name)) {
        const size = absolute ? Math.abs(value) : value;
        low = Math.min(low, size);
        high = Math.max(high, size);
    }
    return high < low ? {low: 0, high: 1} : {low, high};
}
