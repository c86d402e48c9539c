// Which merges are events: by the objects in a target and by their weights in it.

const mergeFilter = {choices: ['', ''], weight: 0};

// True for an object of a choice: of '' every one, of 'road user' every road user, else the one of that name.
function isOfChoice(choice, frame, object) {
    return choice === '' || choice === names[object] ||
        choice === 'road user' && isRoadUser(objectRow(frame, object));
}

// True if two objects have the wanted weight in a target, one of each choice.
function isWantedMerge(frame, target) {
    const weights = new Map();
    const {begin, end} = contributorsOf(target);
    for (let i = begin; i < end; i++) {
        const object = column('contributor_object')[i];
        weights.set(object, (weights.get(object) || 0) + column('contributor_weight')[i]);
    }
    const heavy = [...weights.keys()].filter(object => weights.get(object) >= mergeFilter.weight);
    const [some, others] = mergeFilter.choices.map(choice => heavy.filter(object => isOfChoice(choice, frame, object)));
    return some.some(one => others.some(other => other !== one));
}

function readMergeFilter() {
    mergeFilter.choices = ['merge-one', 'merge-other'].map(id => control(id).value);
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
