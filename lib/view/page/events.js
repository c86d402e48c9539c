// Events of a scene: what begins in a scan, as its sensor's scan before did not show it. Lanes over
// time show events; keys and clicks go from one to the next.

const eventKinds = {
    ghost: {title: 'ghosts', tells: 'a ghost that its sensor did not list in the scan before'},
    merge: {title: 'merges', tells: 'a target begins to have echoes of two objects'},
    split: {title: 'splits', tells: 'a road user begins to have several targets of a sensor'},
    miss: {title: 'misses', tells: 'a road user in the scene loses its last target of a sensor'},
    false_alarm: {title: 'false alarms', tells: 'a target that is nothing but noise'},
    difference: {title: 'differences', tells: 'a missed or false target, or an identity switch'},
};

// shown is the event to which the page went last.
let events = {scene: -1, of: {}, shown: null};

// The targets of a scan that show an event of each kind, by a key that is the same in the next scan.
function keysOfScan(frame, scan) {
    const found = {ghost: new Map(), merge: new Map(), split: new Map(), false_alarm: new Map(), seen: new Map()};
    const {begin, end} = targetsOf(scan);
    for (let target = begin; target < end; target++) {
        const kind = kindOf(target);
        const object = objectOfTarget(target);
        if (kind === 'false_alarm') {
            found.false_alarm.set(`target ${target}`, target); // each false alarm is a new one
        } else if (kind === 'ghost') {
            found.ghost.set(object, target);
        } else if (kind === 'body' && isRoadUser(objectRow(frame, object))) {
            found[found.seen.has(object) ? 'split' : 'seen'].set(object, target);
        }
        if (isMerged(target) && isWantedMerge(frame, target)) {
            const objects = [];
            eachObjectOf(target, one => objects.push(one));
            found.merge.set([...new Set(objects)].sort().join(), target);
        }
    }
    return found;
}

function noteEvent(kind, event) {
    (events.of[kind] ||= []).push(event);
}

function noteScan(row, frame, scan, before) {
    const now = keysOfScan(frame, scan);
    for (const kind of ['ghost', 'merge', 'split', 'false_alarm']) {
        for (const [key, target] of now[kind]) {
            if (!before || !before[kind].has(key)) {
                noteEvent(kind, {row, target, object: objectOfTarget(target)});
            }
        }
    }
    for (const object of before ? before.seen.keys() : []) {
        if (!now.seen.has(object) && objectRow(frame, object) >= 0) {
            noteEvent('miss', {row, target: -1, object});
        }
    }
    return now;
}

// The events of the scene by kind, in order of time.
function eventsOfScene() {
    if (events.scene !== state.scene) {
        events = {scene: state.scene, of: {}, shown: null};
        const before = new Map();
        sceneFrames[state.scene].forEach((frame, row) => {
            const {begin, end} = scansOf(frame);
            for (let scan = begin; scan < end; scan++) {
                if (column('scan_measured')[scan]) {
                    const style = sensorStyle(scan);
                    before.set(style, noteScan(row, frame, scan, before.get(style)));
                }
            }
            differencesOf(frame).forEach(one => noteEvent('difference', {row, ...one}));
        });
    }
    return events.of;
}

// Where an event is: at its target, at a true target that is missed, or at its object.
function placeOfEvent({target, missed, object}) {
    if (target >= 0) {
        return targetPlace(scanOfTarget(state.frame, target), target);
    }
    return missed ? truePlace(missed.scan, missed.truth) : boxOf(objectRow(state.frame, object));
}

// Shows an event: its frame, and its target or object in view.
function showEvent(event) {
    setPlaying(false);
    showRow(event.row);
    events.shown = event;
    if (event.target >= 0) {
        chooseTarget(event.target);
    } else if (event.object >= 0) {
        chooseObject(event.object);
    }
    const place = placeOfEvent(event);
    if (!onScreen(toScreen(place), -10)) {
        Object.assign(camera, cameraFor(placesToFit().concat(toLocal(place))));
        redraw();
    }
}

// The events of a kind, or of all kinds for '', in order of time.
function eventsOfKind(kind) {
    const of = eventsOfScene();
    return Object.keys(eventKinds).filter(one => of[one] && (kind === '' || one === kind))
        .flatMap(one => of[one]).sort((a, b) => a.row - b.row);
}

// The event shown, while the page is at its frame.
function shownEvent() {
    return events.shown && events.shown.row === state.row ? events.shown : null;
}

// Goes to the next or previous event of a kind, or of every kind that has a lane: from the one shown, or
// else from the frame.
function stepEvent(step, kind = state.event) {
    const listed = eventsOfKind(kind);
    const at = listed.indexOf(shownEvent());
    const beyond = listed.filter(({row}) => step * (row - state.row) > 0);
    const next = at >= 0 ? listed[at + step] : beyond[step > 0 ? 0 : beyond.length - 1];
    if (next) {
        showEvent(next);
    }
}

// Goes to the next frame that differs from the other stream.
function stepDifference() {
    const next = eventsOfKind('difference').find(({row}) => row > state.row);
    if (next) {
        showEvent(next);
    }
}

// Lanes over time: a row for each kind that the scene has, with a line where there are events.

const lanes = {scene: -1, drawn: '', canvases: new Map()};

function makeLane(kind, list) {
    const title = button('', () => {
        const again = state.event === kind;
        const at = list.indexOf(shownEvent());
        const next = at >= 0 ? list[at + 1] : list.find(({row}) => row > state.row);
        state.event = kind;
        showEvent((again && next) || list[0]);
    });
    title.textContent = `${eventKinds[kind].title}: ${list.length}`;
    title.title = `${capital(eventKinds[kind].tells)}. Click: to the first, again: to the next (. and ,)`;
    title.dataset.kind = kind;
    const lane = make('canvas');
    lanes.canvases.set(kind, lane);
    lane.addEventListener('click', event => {
        state.event = kind;
        showEvent(eventInLane(list, laneSpan(lane), event.offsetX));
    });
    return [title, lane];
}

// The event of a lane that is nearest to a place in it; of several in that frame, the one after the one shown.
function eventInLane(list, span, x) {
    const places = list.map(({row}) => ({row, x: timePlace(span, row), y: 0}));
    const {row} = nearest(places, {x, y: 0}, Infinity);
    const there = list.filter(one => one.row === row);
    return there[(there.indexOf(shownEvent()) + 1) % there.length];
}

function laneSpan(lane) {
    return {left: overTimeMargin.left, right: lane.clientWidth - overTimeMargin.right};
}

function showLanes() {
    const of = eventsOfScene();
    if (lanes.scene !== state.scene) {
        lanes.scene = state.scene;
        lanes.canvases.clear();
        const kinds = Object.keys(eventKinds).filter(kind => kind !== 'difference' || hasTruth || hasTracks);
        const none = kinds.filter(kind => !of[kind]).map(kind => eventKinds[kind].title).join(', ');
        control('lanes').replaceChildren(...kinds.filter(kind => of[kind]).flatMap(kind => makeLane(kind, of[kind])),
            ...none ? [make('p', `none: ${none}`)] : []);
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
