// The frame and object with which a scene opens: those that show glint's account of targets and
// losses best.

// Counts, for each object of a frame with targets, the most targets of one sensor, lost echoes, and
// targets merged with other objects (foreign); beside is true if a sensor has at least three
// targets of it and lost another echo.
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
        const known = counts.get(object) || {targets: 0, lost: 0, foreign: 0, beside: false};
        known.targets = Math.max(known.targets, targetsHere.get(object));
        known.foreign += isMerged(target) ? 1 : 0;
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
// fourth.
function scoreOf({targets, lost, foreign, beside}, row) {
    if (row < 0) {
        return 0;
    }
    const many = spotsOf(column('object_id')[row]).size >= 6;
    return 3 * Math.min(targets, 3) + (lost > 0 ? 4 : 0) - 0.5 * Math.max(0, lost - 2) -
        2 * foreign + (beside ? 2 : 0) + (many ? 6 : 0);
}

function openingOf(number) {
    const frames = sceneFrames[number];
    const wanted = head.open_frame < 0 ? -1
        : frames.findIndex(frame => frameNumber(frame) === head.open_frame);
    const rows = wanted >= 0 ? [wanted] : frames.map((_, row) => row);
    const stride = Math.ceil(rows.length / 3000);
    let best = {score: 0, object: -1, row: rows[0]};
    for (let i = 0; i < rows.length; i += stride) {
        for (const [object, counts] of countsByObject(frames[rows[i]])) {
            const score = scoreOf(counts, objectRow(frames[rows[i]], object));
            if (score > best.score) {
                best = {score, object, row: rows[i]};
            }
        }
    }
    return best;
}
