// Where a scene opens: at the frame and object that show best what glint is about.

// How well a frame shows what glint is about: one car that yields several targets for a sensor,
// while something of it gets lost.
function objectsSeen(frame) {
    const seen = new Map();
    const {begin, end} = scansOf(frame);
    for (let scan = begin; scan < end; scan++) {
        const here = countTargets(scan, seen);
        countLost(scan, seen, here);
    }
    return seen;
}

function countTargets(scan, seen) {
    const here = new Map();
    const {begin, end} = targetsOf(scan);
    for (let target = begin; target < end; target++) {
        const object = objectOfTarget(target);
        here.set(object, (here.get(object) || 0) + 1);
        const known = seen.get(object) || {targets: 0, lost: 0, foreign: 0, beside: false};
        known.targets = Math.max(known.targets, here.get(object));
        known.foreign += isMerged(target) ? 1 : 0;
        seen.set(object, known);
    }
    return here;
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

function countLost(scan, seen, here) {
    const objects = column('detail_object');
    const {begin, end} = detailsOf(scan);
    for (let i = begin; i < end; i++) {
        const known = seen.get(objects[i]);
        if (known) {
            known.lost++;
            known.beside = known.beside || here.get(objects[i]) >= 3;
        }
    }
}

// Best if one sensor's own list has three targets and lacks a fourth.
function scoreOf({targets, lost, foreign, beside}, row) {
    if (row < 0) {
        return 0;
    }
    const many = classOf(row).points.length >= 6;
    return 3 * Math.min(targets, 3) + (lost > 0 ? 4 : 0) - 0.5 * Math.max(0, lost - 2) -
        2 * foreign + (beside ? 2 : 0) + (many ? 6 : 0);
}

function openingOf(number) {
    const frames = sceneFrames[number];
    const asked = head.open_frame < 0 ? -1
        : frames.findIndex(frame => frameNumber(frame) === head.open_frame);
    const rows = asked >= 0 ? [asked] : frames.map((_, row) => row);
    const stride = Math.ceil(rows.length / 3000);
    let best = {score: 0, object: -1, row: rows[0]};
    for (let i = 0; i < rows.length; i += stride) {
        for (const [object, counts] of objectsSeen(frames[rows[i]])) {
            const score = scoreOf(counts, objectRow(frames[rows[i]], object));
            if (score > best.score) {
                best = {score, object, row: rows[i]};
            }
        }
    }
    return best;
}
