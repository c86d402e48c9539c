// Which merges are events: by the objects in a target and by their weights in it.

const mergeFilter = {objects: [], weight: 0};

// True if at least two objects have the wanted weight in a target, and those that were chosen are among them.
function isWantedMerge(target) {
    const weights = new Map();
    const {begin, end} = contributorsOf(target);
    for (let i = begin; i < end; i++) {
        const object = column('contributor_object')[i];
        weights.set(object, (weights.get(object) || 0) + column('contributor_weight')[i]);
    }
    const heavy = [...weights.keys()].filter(object => weights.get(object) >= mergeFilter.weight);
    return heavy.length > 1 && mergeFilter.objects.every(object => heavy.includes(object));
}

function readMergeFilter() {
    mergeFilter.objects = ['merge-one', 'merge-other'].map(id => control(id).value).filter(Boolean)
        .map(id => names.indexOf(id));
    mergeFilter.weight = Number(control('merge-weight').value);
    events.scene = lanes.scene = -1; // they are found and drawn anew
    lanes.drawn = '';
    refresh();
}

// Offers all objects of the stream that are in a target with others.
function connectMerges() {
    const merged = new Set();
    for (let target = 0; target < column('target_contributors').length; target++) {
        if (isMerged(target)) {
            eachObjectOf(target, object => merged.add(names[object]));
        }
    }
    const sorted = [...merged].sort((a, b) => a.localeCompare(b, 'en', {numeric: true}));
    ['merge-one', 'merge-other'].forEach(id => control(id).append(...sorted.map(name => make('option', name))));
    control('merges').addEventListener('change', readMergeFilter);
    control('merges').hidden = sorted.length === 0;
}
