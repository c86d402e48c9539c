// The view as a link: the part of the address after # states the scene, the frame and what is shown. Opening
// such a link, or loading the page again, shows the same view. Defaults are left out.

let written = null; // the part of the address that the page wrote itself
let writing = 0;

// Writes switches as text, and sets them from a text.
const linkedChoices = {colour: 'sensor', effect: '-1', rates: 'raw', up: 'up', plotted: '',
    'merge-one': '', 'merge-other': '', 'merge-weight': '0'};
const linkedBoxes = {follow: true, trail: true};
const switchedNames = {sensor: sensorNames, path: head.paths, class: names};

function numbersText(values) {
    return values.map(value => Number(value.toPrecision(6))).join();
}

// The numbers of a text, if there are so many.
function numbersOf(text, count) {
    const values = (text || '').split(',').map(Number);
    return values.length === count && values.every(Number.isFinite) ? values : null;
}

// The camera, with the metres that the shorter side of the map shows, so that windows may differ in size.
function cameraText() {
    return numbersText([camera.x, camera.y, Math.min(canvas.clientWidth, canvas.clientHeight) / camera.scale]);
}

function axesText({left, right, bottom, top}) {
    return numbersText([left, right, bottom, top]);
}

// The chosen target, by its sensor and number.
function targetText() {
    const scan = scanOfTarget(state.frame, state.target);
    return `${state.target - targetsOf(scan).begin + 1} ${sensorOf(scan).name}`;
}

// The entries that the legend switches off, as kind and name.
function offNames() {
    return Object.entries(switchedOff).flatMap(([kind, off]) => [...off].map(one => `${kind} ${switchedNames[kind][one]}`));
}

function linkText() {
    const parts = new URLSearchParams();
    parts.set('scene', sceneName(head.scenes[state.scene]));
    parts.set('frame', String(frameNumber(state.frame)));
    parts.set('object', state.object < 0 ? '' : names[state.object]);
    const add = (name, value, usual) => value !== usual && parts.set(name, value);
    Object.entries(linkedChoices).forEach(([id, usual]) => add(id, control(id).value, usual));
    Object.entries(linkedBoxes).forEach(([id, usual]) => add(id, String(control(id).checked), String(usual)));
    add('reflector', state.reflector || '', '');
    add('target', state.target < 0 ? '' : targetText(), '');
    add('cause', state.cause || '', '');
    add('event', state.event, '');
    add('pane', state.pane, 'panel');
    add('large', state.large, '');
    add('map', cameraText(), '');
    Object.entries(plots).forEach(([kind, {axes}]) => add(kind, axes ? axesText(axes) : '', ''));
    offNames().forEach(name => parts.append('off', name));
    return '#' + parts;
}

function writePlace() {
    written = linkText();
    window.history.replaceState(null, '', written);
}

// Writes the address after a pause, once for many changes.
function rememberPlace() {
    clearTimeout(writing);
    writing = setTimeout(writePlace, 200);
}

function copyLink() {
    writePlace();
    copyText(location.href, control('share'), ['✓', '✗', '↗']);
}

// The number of an object's id. A word that labels of no object have, as "roadside", is chosen only where
// no object has it as its id.
function objectNamed(id) {
    const number = column('object_id').find(one => names[one] === id);
    return number !== undefined ? number : names.indexOf(id);
}

// What the address asks for: scene, row and object by number, as far as the stream has them.
function placeOfLink(parts) {
    const named = head.scenes.findIndex(scene => sceneName(scene) === parts.get('scene'));
    const scene = Math.max(0, named);
    const row = !parts.get('frame') ? -1
        : sceneFrames[scene].findIndex(frame => frameNumber(frame) === Number(parts.get('frame')));
    return {scene, place: row < 0 ? null : {row, object: objectNamed(parts.get('object') || undefined)}};
}

function followChoices(parts) {
    for (const [id, usual] of Object.entries(linkedChoices)) {
        const select = control(id);
        const wanted = parts.has(id) ? parts.get(id) : usual;
        if (select.value !== wanted && [...select.options].some(option => option.value === wanted)) {
            select.value = wanted;
            select.dispatchEvent(new Event('change', {bubbles: true}));
        }
    }
    for (const [id, usual] of Object.entries(linkedBoxes)) {
        if (control(id).checked !== (parts.has(id) ? parts.get(id) === 'true' : usual)) {
            control(id).click();
        }
    }
    const off = parts.getAll('off');
    for (const [kind, list] of Object.entries(switchedNames)) {
        switchedOff[kind] = new Set(off.filter(one => one.startsWith(kind + ' '))
            .map(one => list.indexOf(one.slice(kind.length + 1))).filter(number => number >= 0));
    }
    showLegend();
}

// The row of the target that a link names in the frame that is shown, or -1.
function targetOfLink(text) {
    const [, number, name] = /^(\d+) (.*)$/s.exec(text || '') || [];
    const scan = name === undefined ? -1 : scanOfSensor(state.frame, name);
    const {begin, end} = scan < 0 ? {begin: 0, end: 0} : targetsOf(scan);
    return number >= 1 && number <= end - begin ? begin + Number(number) - 1 : -1;
}

function followLink() {
    const parts = new URLSearchParams(location.hash.slice(1));
    followChoices(parts);
    const {scene, place} = placeOfLink(parts);
    setScene(scene, place);
    state.target = targetOfLink(parts.get('target'));
    state.reflector = parts.get('reflector');
    state.cause = parts.get('cause');
    state.event = eventKinds[parts.get('event')] ? parts.get('event') : '';
    const view = place && numbersOf(parts.get('map'), 3);
    if (view) {
        const scale = Math.min(canvas.clientWidth, canvas.clientHeight) / view[2];
        Object.assign(camera, {x: view[0], y: view[1], scale: Math.max(0.2, Math.min(800, scale || 1))});
    }
    for (const [kind, plot] of Object.entries(plots)) {
        const axes = numbersOf(parts.get(kind), 4);
        plot.axes = axes && {left: axes[0], right: axes[1], bottom: axes[2], top: axes[3]};
    }
    state.large = plots[parts.get('large')] ? parts.get('large') : '';
    const pane = panes.get(parts.get('pane'));
    showPane(pane && !pane.tab.hidden ? parts.get('pane') : 'panel');
}

function connectLinks() {
    window.addEventListener('hashchange', () => {
        if (location.hash !== written) {
            followLink();
        }
    });
}
