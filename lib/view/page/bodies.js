// Objects on the map: their outlines, their reflectors, and where late radars measured them.

function traceOutline(box) {
    pen.beginPath();
    for (const corner of outlineOf(box)) {
        const at = toScreen(corner);
        pen.lineTo(at.x, at.y);
    }
    pen.closePath();
}

function drawObjects() {
    const {begin, end} = objectsOf(state.frame);
    for (let row = begin; row < end; row++) {
        drawObject(row);
    }
}

function drawObject(row) {
    const box = boxOf(row);
    const id = column('object_id')[row];
    const isEgo = id === head.scenes[state.scene].ego;
    if (!isClassShown(row) || !onScreen(toScreen(box), Math.max(box.length, box.width) * camera.scale)) {
        return;
    }
    pen.beginPart('object', () => objectLabel(row));
    traceOutline(box);
    pen.fillStyle = isEgo ? ink.ego : ink.body;
    pen.fill();
    strokeOutline(id, isEgo);
    if (box.length * camera.scale > 14 && box.width > 0.25 * box.length) {
        const colour = isEgo ? ink.paper : ink.edge;
        drawHeading(box, colour);
    }
    pen.endPart();
}

function strokeOutline(id, isEgo) {
    const coloured = state.colour === 'object' && !isEgo;
    const chosen = id === state.object;
    pen.lineWidth = (chosen ? 2.2 : 1.2) + (coloured ? 1 : 0);
    pen.strokeStyle = coloured ? objectColour(id) : chosen ? ink.chosen : ink.edge;
    pen.stroke();
}

// Draws a chevron at the front of a box.
function drawHeading(box, colour) {
    pen.strokeStyle = colour;
    pen.lineWidth = 1.2;
    pen.beginPath();
    for (const [x, y] of [[0.4, 0.22], [0.46, 0], [0.4, -0.22]]) {
        const at = toScreen(placeIn(box, x, y));
        pen.lineTo(at.x, at.y);
    }
    pen.stroke();
}

// Draws a dot at every reflector of an object that the stream has named anywhere in the scene.
function drawReflectors() {
    const {begin, end} = objectsOf(state.frame);
    for (let row = begin; row < end && camera.scale >= 6; row++) {
        if (isClassShown(row)) {
            drawReflectorsOf(row);
        }
    }
}

function drawReflectorsOf(row) {
    const box = boxOf(row);
    for (const spot of spotsOf(column('object_id')[row]).values()) {
        const at = toScreen(spotPlace(box, spot));
        if (onScreen(at, 2)) {
            drawDot(at, 1.7, ink.edge);
        }
    }
}

function reflectorMeanings() {
    return [meaning(dotMark(ink.edge), 'reflection centre')];
}

// Draws where scans measured the bodies that they have targets of, if these have moved since.
function drawMeasuredBodies() {
    eachScan(drawMeasuredIn);
}

function drawMeasuredIn(scan) {
    const age = column('scan_age_s')[scan];
    const {begin, end} = objectsOf(state.frame);
    if (!(age > 0) || !column('scan_measured')[scan]) {
        return;
    }
    for (let row = begin; row < end; row++) {
        const id = column('object_id')[row];
        const way = age * Math.hypot(column('object_vx_mps')[row], column('object_vy_mps')[row]);
        if (way * camera.scale >= 3 && id !== head.scenes[state.scene].ego &&
            (id === state.object || targetsFrom(scan, id).length > 0)) {
            traceOutline(measuredBox(scan, row));
            pen.setLineDash([3, 3]);
            pen.lineWidth = 1.2;
            pen.strokeStyle = id === state.object ? ink.chosen : ink.edge;
            pen.stroke();
            pen.setLineDash([]);
        }
    }
}

function measuredMeanings() {
    const mark = drawing => {
        drawing.strokeStyle = ink.edge;
        drawing.lineWidth = 1;
        drawing.setLineDash([3, 3]);
        drawing.strokeRect(2, 4, 14, 8);
    };
    return extremes('scan_age_s', false).high > 1e-6 ? [meaning(mark, 'where the body was when measured')] : [];
}

function labelAge() {
    const row = objectRow(state.frame, state.object);
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; row >= 0 && scan < end; scan++) {
        const age = column('scan_age_s')[scan];
        const way = age * Math.hypot(column('object_vx_mps')[row], column('object_vy_mps')[row]);
        if (way * camera.scale >= 3 && targetsFrom(scan, state.object).length > 0) {
            putLabel(`${round(1000 * age, 0)} ms before`, toScreen(measuredBox(scan, row)), ink.soft);
            return;
        }
    }
}
