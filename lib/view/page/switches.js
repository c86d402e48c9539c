// The legend's lines that switch sensors, paths and classes off. Their targets are then neither drawn nor
// listed, and objects of such a class are not drawn.

const switchedOff = {sensor: new Set(), path: new Set(), class: new Set()};

let classesHere = {frame: -1, of: new Map()};

// The class of an object in a frame, by the number of its name; -1 for what is no object.
function classOfObject(frame, object) {
    if (classesHere.frame !== frame) {
        const {begin, end} = objectsOf(frame);
        classesHere = {frame, of: new Map()};
        for (let row = begin; row < end; row++) {
            classesHere.of.set(column('object_id')[row], column('object_class')[row]);
        }
    }
    const found = classesHere.of.get(object);
    return found === undefined ? -1 : found;
}

const standing = new Set(['guardrail', 'post', 'wall']); // classes that are no road users

// False for a row of no object, -1.
function isRoadUser(row) {
    return row >= 0 && !standing.has(names[column('object_class')[row]]);
}

function isSensorShown(scan) {
    return !switchedOff.sensor.has(sensorStyle(scan));
}

function isClassShown(row) {
    return !switchedOff.class.has(column('object_class')[row]);
}

function isTargetShown(frame, target) {
    return !switchedOff.path.has(column('contributor_path')[leaderOf(target)]) &&
        (switchedOff.class.size === 0 ||
            !switchedOff.class.has(classOfObject(frame, objectOfTarget(target))));
}

// Visits the targets of a frame that are switched on.
function eachTarget(frame, visit) {
    const {begin, end} = scansOf(frame);
    for (let scan = begin; scan < end; scan++) {
        if (!isSensorShown(scan)) {
            continue;
        }
        const targets = targetsOf(scan);
        for (let target = targets.begin; target < targets.end; target++) {
            if (isTargetShown(frame, target)) {
                visit(scan, target);
            }
        }
    }
}

// A line of the legend that switches a kind of targets off and on.
function switchLine(kind, value, mark, text) {
    const line = make('label');
    const box = make('input');
    box.type = 'checkbox';
    box.checked = !switchedOff[kind].has(value);
    box.addEventListener('change', () => {
        switchedOff[kind][box.checked ? 'delete' : 'add'](value);
        refresh();
    });
    line.append(box, ...(mark ? [mark] : []), make('bdi', text));
    return line;
}

function switchGroup(title, lines) {
    return lines.length < 2 ? [] : [make('b', title), ...lines];
}

// The switches of paths and classes, folded away until they are wanted.
function switchesBelow() {
    const classes = [...new Set(column('object_class'))];
    const fold = make('details');
    fold.id = 'switches';
    fold.open = control('switches') !== null && control('switches').open;
    fold.append(make('summary', 'show only …'),
        ...switchGroup('paths', pathsSeen.map(path => switchLine('path', path, null, words(head.paths[path])))),
        ...switchGroup('classes', classes.map(kind => switchLine('class', kind, null, names[kind]))));
    fold.hidden = fold.children.length < 2;
    return fold;
}

function shownTargetsFrom(scan, object) {
    return !isSensorShown(scan) ? []
        : targetsFrom(scan, object).filter(({target}) => isTargetShown(state.frame, target));
}
