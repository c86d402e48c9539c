// Events of a scene: what begins in a scan, as its sensor's scan before did not show it. Lanes over
// time show events; keys and clicks go from one to the next.

const eventKinds = {
    ghost: {title: 'ghosts', tells: 'a ghost that its sensor did not list in the scan before'},
    merge: {title: 'merges', tells: 'a target begins to have echoes of two objects'},
    split: {title: 'splits', tells: 'an object begins to have several targets of a sensor'},
    miss: {title: 'misses', tells: 'an object in the scene loses its last target of a sensor'},
    false_alarm: {title: 'false alarms', tells: 'a target that is nothing but noise'},
    difference: {title: 'differences', tells: 'a missed or false target, or an identity switch'},
};

let events = {scene: -1, of: {}};

// The targets of a scan that show an event of each kind, by a key that is the same in the next scan.
function keysOfScan(scan) {
    const found = {ghost: new Map(), merge: new Map(), split: new Map(), false_alarm: new Map(), seen: new Map()};
    const {begin, end} = targetsOf(scan);
    for (let target = begin; target < end; target++) {
        const kind = kindOf(target);
        const object = objectOfTarget(target);
        if (kind === 'false_alarm') {
            found.false_alarm.set(`target ${target}`, target); // each false alarm is a new one
        } else if (kind === 'ghost') {
            found.ghost.set(object, target);
        } else if (kind === 'body') {
            found[found.seen.has(object) ? 'split' : 'seen'].set(object, target);
        }
        if (isMerged(target)) {
            const objects = [];
            eachObjectOf(target, one => objects.push(one));
            found.merge.set([...new Set(objects)].sort().join(), target);
        }
    }
    return found;
}

function noteEvent(kind, row, target, object) {
    const known = events.of[kind] = events.of[kind] || [];
    if (known.length === 0 || known[known.length - 1].row !== row) {
        known.push({row, target, object});
    }
}

function noteScan(row, frame, scan, before) {
    const now = keysOfScan(scan);
    for (const kind of ['ghost', 'merge', 'split', 'false_alarm']) {
        for (const [key, target] of now[kind]) {
            if (!before || !before[kind].has(key)) {
                noteEvent(kind, row, target, objectOfTarget(target));
            }
        }
    }
    for (const object of before ? before.seen.keys() : []) {
        if (!now.seen.has(object) && objectRow(frame, object) >= 0) {
            noteEvent('miss', row, -1, object);
        }
    }
    return now;
}

// The events of the scene by kind: at most one in a frame, in order of time.
function eventsOfScene() {
    if (events.scene !== state.scene) {
        events = {scene: state.scene, of: {}};
        const before = new Map();
        sceneFrames[state.scene].forEach((frame, row) => {
            const {begin, end} = scansOf(frame);
            for (let scan = begin; scan < end; scan++) {
                if (column('scan_measured')[scan]) {
                    const style = sensorStyle(scan);
                    before.set(style, noteScan(row, frame, scan, before.get(style)));
                }
            }
            if (isDifferent(frame)) {
                noteEvent('difference', row, -1, -1);
            }
        });
    }
    return events.of;
}

// Shows an event: its frame, and its target or object in view.
function showEvent({row, target, object}) {
    setPlaying(false);
    showRow(row);
    if (target >= 0) {
        chooseTarget(target);
    } else if (object >= 0) {
        chooseObject(object);
    }
    const scan = target >= 0 ? scanOfTarget(state.frame, target) : -1;
    const place = scan >= 0 ? targetPlace(scan, target) : object >= 0 ? boxOf(objectRow(state.frame, object)) : null;
    if (place && !onScreen(toScreen(place), -10)) {
        Object.assign(camera, cameraFor(placesToFit().concat(toLocal(place))));
        redraw();
    }
}

// Goes to the next or previous event of a kind, or of every kind that the legend of lanes has.
function stepEvent(step, kind = state.event) {
    const listed = Object.entries(eventsOfScene()).filter(([one]) => kind === '' || one === kind)
        .flatMap(([, list]) => list).filter(({row}) => step * (row - state.row) > 0)
        .sort((a, b) => step * (a.row - b.row));
    if (listed.length > 0) {
        showEvent(listed[0]);
    }
}

// Lanes over time: a row for each kind that the scene has, with a line for each event.

const lanes = {scene: -1, drawn: '', canvases: new Map()};

function makeLane(kind, list) {
    const title = button('', () => {
        const again = state.event === kind;
        state.event = kind;
        showEvent((again && list.find(({row}) => row > state.row)) || list[0]);
    });
    title.textContent = `${eventKinds[kind].title}: ${list.length}`;
    title.title = `${capital(eventKinds[kind].tells)}. Click: to the first, again: to the next (. and ,)`;
    title.dataset.kind = kind;
    const lane = make('canvas');
    lane.addEventListener('click', event => {
        state.event = kind;
        const at = {x: event.offsetX, y: 0};
        showEvent(nearest(list.map(one => ({...one, x: timePlace(laneSpan(lane), one.row), y: 0})), at, Infinity));
    });
    lanes.canvases.set(kind, lane);
    return [title, lane];
}

function laneSpan(lane) {
    return {left: overTimeMargin.left, right: lane.clientWidth - overTimeMargin.right};
}

function showLanes() {
    const of = eventsOfScene();
    if (lanes.scene !== state.scene) {
        lanes.scene = state.scene;
        lanes.canvases.clear();
        control('lanes').replaceChildren(...Object.keys(eventKinds).filter(kind => of[kind])
            .flatMap(kind => makeLane(kind, of[kind])));
    }
    const look = [state.scene, control('lanes').clientWidth, isDark(), state.event].join();
    if (lanes.drawn !== look) {
        lanes.drawn = look;
        lanes.canvases.forEach((lane, kind) => drawLane(lane, of[kind], kind === state.event));
    }
    for (const title of control('lanes').querySelectorAll('button')) {
        title.setAttribute('aria-pressed', String(title.dataset.kind === state.event));
    }
}

function drawLane(lane, list, chosen) {
    const drawing = lane.getContext('2d');
    const {height} = fitCanvas(lane, drawing);
    const span = laneSpan(lane);
    plotRule(drawing, {x: span.left, y: height - 0.5}, {x: span.right, y: height - 0.5}, false);
    drawing.fillStyle = chosen ? ink.chosen : ink.edge;
    new Set(list.map(({row}) => Math.round(timePlace(span, row))))
        .forEach(x => drawing.fillRect(x - 0.75, 0, 1.5, height));
}
