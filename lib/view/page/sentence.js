// The frame in a sentence: which radars, which scene and frame, how many targets of what, and how many
// echoes are lost.

const countWords = ['no', 'one', 'two', 'three', 'four', 'five', 'six', 'seven', 'eight', 'nine', 'ten',
    'eleven', 'twelve'];

function capital(text) {
    return text.charAt(0).toUpperCase() + text.slice(1);
}

// The radars of a frame by their bands: "two 24 GHz radars and one 77 GHz radar".
function radarWords(frame) {
    const bands = new Map();
    const {begin, end} = scansOf(frame);
    for (let scan = begin; scan < end; scan++) {
        const carrier = sensorOf(scan).carrier_hz;
        const band = carrier > 0 ? `${Math.round(carrier / 1e9)} GHz radar` : 'radar';
        bands.set(band, (bands.get(band) || 0) + 1);
    }
    const parts = [...bands].map(([band, count]) =>
        `${countWords[count] || count} ${band}${count === 1 ? '' : 's'}`);
    return parts.length > 0 ? parts.join(' and ') : 'no radar';
}

// The scene's name without the ego's, which glint-traffic puts behind it.
function sceneWords() {
    const {name, ego} = head.scenes[state.scene];
    const end = '/' + names[ego];
    return names[name].endsWith(end) ? names[name].slice(0, -end.length) : names[name];
}

function eachObjectOf(target, visit) {
    const {begin, end} = contributorsOf(target);
    column('contributor_object').slice(begin, end).forEach(visit);
}

// How many targets of a frame are of each kind, how many objects sent their echoes, and how many have
// echoes of several.
function countTargetKinds(frame) {
    const found = {body: 0, ghost: 0, clutter: 0, false_alarm: 0, merged: 0, objects: new Set()};
    const {begin, end} = scansOf(frame);
    const first = starts('scan_targets');
    for (let target = first[begin]; target < first[end]; target++) {
        const kind = kindOf(target);
        found[kind]++;
        if (kind === 'body' || kind === 'ghost') {
            eachObjectOf(target, object => found.objects.add(object));
            found.merged += isMerged(target) ? 1 : 0;
        }
    }
    return found;
}

function targetCountWords(frame) {
    const {body, ghost, clutter, false_alarm: alarms, merged, objects} = countTargetKinds(frame);
    const parts = [`${plural(body + ghost, 'target')}` +
        (objects.size > 0 ? ` of ${plural(objects.size, 'object')}` : '')];
    const add = (count, text) => parts.push(...(count > 0 ? [`${count} ${text}`] : []));
    add(merged, 'merged');
    add(ghost, ghost === 1 ? 'a ghost' : 'ghosts');
    add(clutter, 'of clutter');
    add(alarms, alarms === 1 ? 'false alarm' : 'false alarms');
    return parts;
}

function lostWords(frame) {
    const lost = frameCauses(frame).filter(({item}) => item.reason.notable)
        .reduce((sum, {count}) => sum + count, 0);
    return lost > 0 ? [`${plural(lost, 'echo').replace(/os$/, 'oes')} lost`] : [];
}

function frameSentence() {
    const {begin, end} = scansOf(state.frame);
    const count = sceneFrames[state.scene].length;
    const where = `${capital(radarWords(state.frame))}, ${sceneWords()}, ` +
        `frame ${frameNumber(state.frame)} of ${count}`;
    if (end === begin) {
        const objects = objectsOf(state.frame);
        return `${where}: ${plural(objects.end - objects.begin, 'object')}`;
    }
    const measured = column('scan_measured').slice(begin, end).some(one => one > 0);
    return `${where}: ` + (measured ? targetCountWords(state.frame).concat(lostWords(state.frame)).join(', ')
        : 'no radar measured in this frame');
}

function showSentence() {
    setText(control('sentence'), frameSentence());
}
