// The frame and object with which a scene opens: those that show what the scene is about, and glint's
// account of targets and losses.

// Effects that nearly every scene has.
const commonEffects = ['visibility', 'plane_reflection', 'rows', 'merging', 'superposition', 'angle_noise',
    'range_noise', 'quantisation', 'latency', 'elevation', 'accuracy']
    .map(name => head.effects.indexOf(name));

// The effects that a scene is about: those of some of its targets, as far as they are not common.
function effectsOfScene(frames) {
    const counts = new Map();
    let all = 0;
    const first = starts('scan_targets');
    for (const frame of frames) {
        const {begin, end} = scansOf(frame);
        for (let target = first[begin]; target < first[end]; target++, all++) {
            effectsOf(target).forEach(effect => counts.set(effect, (counts.get(effect) || 0) + 1));
        }
    }
    const found = new Set([...counts].filter(([effect, count]) => !commonEffects.includes(effect) &&
        count >= 0.002 * all).map(([effect]) => effect));
    if (found.size > 1) {
        found.delete(head.effects.indexOf('false_alarms')); // they come with every radar that has others
    }
    return found;
}

const nearRange = 80; // m, which the first view shows (openView)

// The near targets of a frame that have an effect which the scene is about.
function targetsAbout(frame, effects) {
    const found = [];
    const {begin, end} = scansOf(frame);
    const first = starts('scan_targets');
    for (let target = first[begin]; target < first[end]; target++) {
        if (column('target_range_m')[target] < nearRange && effectsOf(target).some(effect => effects.has(effect))) {
            found.push(target);
        }
    }
    return found;
}

// Counts, for each object of a frame with targets, the most targets of one sensor, lost echoes, and
// targets merged with other objects (foreign); beside is true if a sensor has at least three
// targets of it and lost another echo; range is that of its nearest target, m.
function countsByObject(frame) {
    const counts = new Map();
    const {begin, end} = scansOf(frame);
    for (let scan = begin; scan < end; scan++) {
        const targetsHere = countTargets(scan, counts);
        countLost(scan, counts, targetsHere);
    }
    return counts;
}

function countTargets(scan, counts) {
    const targetsHere = new Map();
    const {begin, end} = targetsOf(scan);
    for (let target = begin; target < end; target++) {
        const object = objectOfTarget(target);
        targetsHere.set(object, (targetsHere.get(object) || 0) + 1);
        const known = counts.get(object) || {targets: 0, lost: 0, foreign: 0, beside: false, range: Infinity};
        known.targets = Math.max(known.targets, targetsHere.get(object));
        known.foreign += isMerged(target) ? 1 : 0;
        known.range = Math.min(known.range, column('target_range_m')[target]);
        counts.set(object, known);
    }
    return targetsHere;
}

function isMerged(target) {
    const objects = column('contributor_object');
    const {begin, end} = contributorsOf(target);
    for (let i = begin + 1; i < end; i++) {
        if (objects[i] !== objects[begin]) {
            return true;
        }
    }
    return false;
}

function countLost(scan, counts, targetsHere) {
    const objects = column('detail_object');
    const {begin, end} = detailsOf(scan);
    for (let i = begin; i < end; i++) {
        const known = counts.get(objects[i]);
        if (known) {
            known.lost++;
            known.beside = known.beside || targetsHere.get(objects[i]) >= 3;
        }
    }
}

// The score of an object's counts: best where one sensor has three targets of it and lacks a
// fourth, less beyond 50 m, where the map must show bodies small.
function scoreOf({targets, lost, foreign, beside, range}, row) {
    if (row < 0) {
        return hasObjects ? 0 : Math.min(targets, 3);
    }
    const many = spotsOf(column('object_id')[row]).size >= 6;
    return 3 * Math.min(targets, 3) + (lost > 0 ? 4 : 0) - 0.5 * Math.max(0, lost - 2) -
        2 * foreign + (beside ? 2 : 0) + (many ? 6 : 0) - Math.max(0, range - 50) / 25;
}

// The best object of a frame, and its score with that of the effects that the frame shows.
function bestOf(frame, row, effects) {
    let best = {score: 0, object: -1, row};
    const shown = targetsAbout(frame, effects);
    const seen = object => new Set(shown.filter(target => object === undefined || objectOfTarget(target) === object)
        .flatMap(effectsOf).filter(effect => effects.has(effect)));
    for (const [object, counts] of countsByObject(frame)) {
        const score = scoreOf(counts, objectRow(frame, object)) + 2 * seen(object).size;
        if (score > best.score) {
            best = {score, object, row};
        }
    }
    best.score += 8 * seen().size;
    return best;
}

function openingOf(number) {
    const frames = sceneFrames[number];
    const wanted = head.open_frame < 0 ? -1
        : frames.findIndex(frame => frameNumber(frame) === head.open_frame);
    const rows = wanted >= 0 ? [wanted] : frames.map((_, row) => row);
    const stride = Math.ceil(rows.length / 3000);
    const sample = rows.filter((_, i) => i % stride === 0);
    const effects = effectsOfScene(sample.map(row => frames[row]));
    let best = {score: -1, object: -1, row: rows[0]};
    for (const row of sample) {
        const found = bestOf(frames[row], row, effects);
        best = found.score > best.score ? found : best;
    }
    return best;
}
