// Objects on the map: their outlines, their reflectors, and where late radars measured them.

function traceOutline(box) {
    context.beginPath();
    for (const corner of outlineOf(box)) {
        const at = toScreen(corner);
        context.lineTo(at.x, at.y);
    }
    context.closePath();
}

function drawObject(row) {
    const box = boxOf(row);
    const id = column('object_id')[row];
    const isEgo = id === head.scenes[state.scene].ego;
    if (!isClassShown(row) || !onScreen(toScreen(box), Math.max(box.length, box.width) * camera.scale)) {
        return;
    }
    traceOutline(box);
    context.fillStyle = isEgo ? ink.ego : ink.body;
    context.fill();
    strokeOutline(id, isEgo);
    if (box.length * camera.scale > 14 && box.width > 0.25 * box.length) {
        const colour = isEgo ? ink.paper : ink.edge;
        drawHeading(box, colour);
    }
}

function strokeOutline(id, isEgo) {
    const coloured = state.colour === 'object' && !isEgo;
    const chosen = id === state.object;
    context.lineWidth = (chosen ? 2.2 : 1.2) + (coloured ? 1 : 0);
    context.strokeStyle = coloured ? objectColour(id) : chosen ? ink.chosen : ink.edge;
    context.stroke();
}

// Draws a chevron at the front of a box.
function drawHeading(box, colour) {
    context.strokeStyle = colour;
    context.lineWidth = 1.2;
    context.beginPath();
    for (const [x, y] of [[0.4, 0.22], [0.46, 0], [0.4, -0.22]]) {
        const at = toScreen(placeIn(box, x, y));
        context.lineTo(at.x, at.y);
    }
    context.stroke();
}

// Draws a dot at every reflector of an object that the stream has named anywhere in the scene.
function drawReflectors(row) {
    if (!isClassShown(row) || camera.scale < 6) {
        return;
    }
    const box = boxOf(row);
    for (const spot of spotsOf(column('object_id')[row]).values()) {
        const at = toScreen(spotPlace(box, spot));
        if (onScreen(at, 2)) {
            drawDot(at, 1.7, ink.edge);
        }
    }
}

// Draws where a scan measured the bodies that it has targets of, if they have moved since.
function drawMeasuredBodies(scan) {
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
            context.setLineDash([3, 3]);
            context.lineWidth = 1.2;
            context.strokeStyle = id === state.object ? ink.chosen : ink.edge;
            context.stroke();
            context.setLineDash([]);
        }
    }
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
