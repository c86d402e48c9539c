// What became of echoes, on the map: those of the chosen object or reflector, and those of a cause.

// The notable losses of the chosen object: by echo, its place and each sensor's reason.
function lostEchoes() {
    const found = new Map();
    eachScan(scan => {
        for (const loss of lossesOf(scan, state.object).filter(one => one.reason.notable)) {
            const known = found.get(echoKey(state.object, loss)) ||
                {name: echoWords(loss.reflector, loss), place: lossPlace(scan, loss), reasons: []};
            known.reasons.push(`${shortReason(loss)} for ${sensorOf(scan).name}`);
            found.set(echoKey(state.object, loss), known);
        }
    });
    return [...found.values()].filter(one => one.place !== null);
}

// Draws what became of the chosen object's reflection centres: contributors of targets, and crosses
// on lost ones.
function drawFates() {
    const row = objectRow(state.frame, state.object);
    if (row < 0) {
        return;
    }
    for (const scan of numbersIn(scansOf(state.frame))) {
        for (const {target} of shownTargetsFrom(scan, state.object)) {
            drawContributors(scan, target, false);
        }
    }
    lostEchoes().forEach(({place}) => drawLostMark(pen, toScreen(place), 5));
}

function lossMeanings() {
    return column('frame_account').includes(1)
        ? [meaning(drawing => drawLostMark(drawing, {x: 9, y: 8}, 5), 'echo that is in no target')] : [];
}

function labelFates() {
    const row = objectRow(state.frame, state.object);
    if (row < 0) {
        return;
    }
    labelTargets();
    for (const {name, place, reasons} of lostEchoes().slice(0, 8)) {
        putLabel(`${name}: ${reasons.join(', ')}`, toScreen(place), ink.lost);
    }
}

// Draws rings where the echoes of the chosen reflector are.
function drawChosenReflector() {
    if (!state.reflector) {
        return;
    }
    pen.strokeStyle = ink.chosen;
    pen.lineWidth = 2.5;
    for (const place of chosenPlaces()) {
        const at = toScreen(place);
        pen.beginPath();
        pen.arc(at.x, at.y, 8, 0, 2 * Math.PI);
        pen.stroke();
    }
}

// Draws crosses on the losses of the cause that is shown, of all objects.
function drawCause() {
    if (state.cause === null || state.object >= 0) {
        return;
    }
    for (const place of placesOfCause()) {
        drawLostMark(pen, toScreen(place), 4);
    }
}

// Where the losses of the cause are that is shown.
function placesOfCause() {
    return lossesFor(state.cause).map(({scan, loss}) => lossPlace(scan, loss)).filter(Boolean);
}
