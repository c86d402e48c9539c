// The bird's-eye view. "Local" coordinates are the ego's (x ahead, y left) while the view follows
// it, else the scene's; the camera's x and y are a local place, its scale is pixels per metre.

const canvas = document.getElementById('map');
const context = canvas.getContext('2d');

let mapSize = {width: 0, height: 0}; // in CSS pixels, as drawn last; to ask the canvas takes long

const camera = {x: 12, y: 0, scale: 20};

function egoBox() {
    const row = objectRow(state.frame, head.scenes[state.scene].ego);
    return row < 0 ? null : boxOf(row);
}

function toLocal(place) {
    const ego = state.follow ? state.ego : null;
    if (!ego) {
        return place;
    }
    const dx = place.x - ego.x;
    const dy = place.y - ego.y;
    return {x: dx * ego.cos + dy * ego.sin, y: dy * ego.cos - dx * ego.sin};
}

function fromLocal(local) {
    const ego = state.follow ? state.ego : null;
    if (!ego) {
        return {x: local.x, y: local.y};
    }
    return {
        x: ego.x + local.x * ego.cos - local.y * ego.sin,
        y: ego.y + local.x * ego.sin + local.y * ego.cos,
    };
}

function localToScreen(local) {
    const ahead = (local.x - camera.x) * camera.scale;
    const left = (local.y - camera.y) * camera.scale;
    const middle = {x: mapSize.width / 2, y: mapSize.height / 2};
    return state.up === 'right' ? {x: middle.x + ahead, y: middle.y - left}
        : {x: middle.x - left, y: middle.y - ahead};
}

function screenToLocal(x, y) {
    const right = (x - canvas.clientWidth / 2) / camera.scale;
    const above = (canvas.clientHeight / 2 - y) / camera.scale;
    return state.up === 'right' ? {x: camera.x + right, y: camera.y + above}
        : {x: camera.x + above, y: camera.y - right};
}

function toScreen(place) {
    return localToScreen(toLocal(place));
}

// The angle on the screen of a direction in the scene.
function screenAngle(yaw) {
    const turned = yaw - (state.follow && state.ego ? state.ego.yaw : 0);
    return -(turned + (state.up === 'right' ? 0 : Math.PI / 2));
}

function line(from, to) {
    context.beginPath();
    context.moveTo(from.x, from.y);
    context.lineTo(to.x, to.y);
    context.stroke();
}

function drawBeam(scan) {
    const sensor = sensorOf(scan);
    const at = toScreen(scanPlace(scan, 0, 0));
    const middle = screenAngle(column('scan_yaw_rad')[scan]);
    const half = sensor.field_of_view_rad / 2;
    const colour = ink.palette[sensorStyle(scan) % ink.palette.length];
    context.beginPath();
    context.moveTo(at.x, at.y);
    context.arc(at.x, at.y, sensor.range_max_m * camera.scale, middle - half, middle + half);
    context.closePath();
    context.globalAlpha = 0.035;
    context.fillStyle = colour;
    context.fill();
    context.globalAlpha = 0.55;
    context.strokeStyle = colour;
    context.lineWidth = 1;
    context.setLineDash(column('scan_measured')[scan] ? [6, 4] : [1, 5]);
    context.stroke();
    context.setLineDash([]);
    context.globalAlpha = 1;
}

// Draws the strips on which rails, poles, kerbs and vegetation stand: bands as wide as they are, or
// lines, which are dotted for poles.
function drawRoadside() {
    for (const strip of head.scenes[state.scene].roadside || []) {
        context.strokeStyle = strip.width_m > 0 ? ink.grid : ink.edge;
        context.lineWidth = Math.max(1.5, (strip.width_m || 0) * camera.scale);
        context.setLineDash(strip.kind === 'poles' ? [2, 6] : []);
        line(toScreen({x: strip.from_x_m, y: strip.from_y_m}), toScreen({x: strip.to_x_m, y: strip.to_y_m}));
    }
    context.setLineDash([]);
}

function traceOutline(box) {
    context.beginPath();
    for (const corner of outlineOf(box)) {
        const at = toScreen(corner);
        context.lineTo(at.x, at.y);
    }
    context.closePath();
}

function onScreen(at, margin) {
    return at.x > -margin && at.y > -margin && at.x < mapSize.width + margin &&
        at.y < mapSize.height + margin;
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

function drawDot(at, radius, colour) {
    context.beginPath();
    context.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    context.fillStyle = colour;
    context.fill();
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

// Draws the echoes in a target as dots.
function drawEchoes(scan, target) {
    const {begin, end} = contributorsOf(target);
    for (let i = begin; i < end && camera.scale >= 3; i++) {
        const at = toScreen(contributorPlace(scan, i));
        if (onScreen(at, 2)) {
            drawDot(at, 2.2, ink.ink);
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

function drawTrail() {
    const frames = sceneFrames[state.scene];
    const times = column('frame_time_s');
    const now = times[state.frame];
    for (let at = state.row - 1; state.ego && at >= 0 && times[frames[at]] > now - 0.5; at--) {
        context.globalAlpha = 0.45 * (1 - (now - times[frames[at]]) / 0.5);
        eachTarget(frames[at], (scan, target) => {
            drawDot(toScreen(targetPlace(scan, target)), 2.2, colourOf(scan, target));
        });
    }
    context.globalAlpha = 1;
}

// Draws a target's range rate as its way in half a second, along the line of sight, away from the
// sensor if it recedes.
function drawRate(scan, target, colour) {
    const rate = rateOf(scan, target, state.rates === 'compensated');
    if (rate === null || Math.abs(rate) < 0.02) {
        return;
    }
    const range = column('target_range_m')[target];
    const azimuth = column('target_azimuth_rad')[target];
    const from = toScreen(scanPlace(scan, range, azimuth));
    const to = toScreen(scanPlace(scan, range + rate / 2, azimuth));
    if (isRateFolded(scan, target)) {
        drawFoldedRate(context, from, to, colour);
        return;
    }
    context.strokeStyle = colour;
    context.lineWidth = 1.6;
    line(from, to);
}

// Draws a rate that stands for another as a dashed arrow.
function drawFoldedRate(drawing, from, to, colour) {
    const angle = Math.atan2(to.y - from.y, to.x - from.x);
    drawing.strokeStyle = colour;
    drawing.lineWidth = 1.6;
    drawing.setLineDash([3, 3]);
    drawing.beginPath();
    drawing.moveTo(from.x, from.y);
    drawing.lineTo(to.x, to.y);
    drawing.stroke();
    drawing.setLineDash([]);
    drawing.beginPath();
    for (const side of [2.6, 0, -2.6]) {
        const reach = side === 0 ? 0 : 6;
        drawing.lineTo(to.x + reach * Math.cos(angle + side), to.y + reach * Math.sin(angle + side));
    }
    drawing.stroke();
}

function drawTarget(scan, target) {
    const at = toScreen(targetPlace(scan, target));
    const colour = colourOf(scan, target);
    drawRate(scan, target, colour);
    drawTargetSymbol(context, sensorStyle(scan), at.x, at.y, target === state.target ? 9.5 : 7, colour,
        kindOf(target));
    if (isInterfered(target)) {
        drawBolt(context, at.x, at.y, 6);
    }
    if (target === state.target) {
        context.beginPath();
        context.arc(at.x, at.y, 15, 0, 2 * Math.PI);
        context.strokeStyle = ink.chosen;
        context.lineWidth = 2;
        context.stroke();
    }
}

// Draws a target's contributors, tied to it by lines as wide as their weights.
function drawContributors(scan, target, strong) {
    const at = toScreen(targetPlace(scan, target));
    const colour = colourOf(scan, target);
    const {begin, end} = contributorsOf(target);
    const weights = column('contributor_weight');
    for (let i = begin; i < end; i++) {
        const from = toScreen(contributorPlace(scan, i));
        context.strokeStyle = colour;
        context.globalAlpha = strong ? 0.9 : 0.6;
        context.lineWidth = 1 + 3 * weights[i];
        line(from, at);
        context.globalAlpha = 1;
        drawDot(from, strong ? 5.5 : 4.5, ink.paper);
        drawDot(from, strong ? 4 : 3, colour);
        if (strong) {
            drawOriginal(scan, i);
        }
    }
}

// Draws a line from where a ghost is seen to the reflector of which it is a ghost.
function drawOriginal(scan, i) {
    const object = column('contributor_object')[i];
    const row = objectRow(state.frame, object);
    const spot = spotsOf(object).get(column('contributor_reflector')[i]);
    if (row < 0 || spot === undefined || !isGhostPath(column('contributor_path')[i])) {
        return;
    }
    context.strokeStyle = ink.soft;
    context.lineWidth = 1.2;
    context.setLineDash([2, 4]);
    line(toScreen(contributorPlace(scan, i)), toScreen(spotPlace(measuredBox(scan, row), spot)));
    context.setLineDash([]);
}

function labelContributor(scan, i) {
    const from = toScreen(contributorPlace(scan, i));
    putLabel(`${contributorWords(i)} ${percent(column('contributor_weight')[i])}`, from, ink.ink);
}

function labelContributors(target) {
    const scan = scanOfTarget(state.frame, target);
    const {begin, end} = contributorsOf(target);
    for (let i = begin; i < Math.min(end, begin + 8); i++) {
        labelContributor(scan, i);
    }
}

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
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; scan < end; scan++) {
        for (const {target} of shownTargetsFrom(scan, state.object)) {
            drawContributors(scan, target, false);
        }
    }
    lostEchoes().forEach(({place}) => drawLostMark(context, toScreen(place), 5));
}

function labelTargets() {
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; scan < end; scan++) {
        for (const {target, number} of shownTargetsFrom(scan, state.object).slice(0, 12)) {
            putLabel(String(number), toScreen(targetPlace(scan, target)), colourOf(scan, target), true);
        }
    }
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

// Draws the ring one cell wide in range around the leader of a target: other echoes in it with a
// similar range rate have no target of their own.
function drawCellRing(scan, target) {
    const cell = cellOf(scan);
    if (!cell) {
        return;
    }
    const range = column('contributor_range_m')[leaderOf(target)];
    const sensor = sensorOf(scan);
    const at = toScreen(scanPlace(scan, 0, 0));
    const middle = screenAngle(column('scan_yaw_rad')[scan]);
    const half = sensor.field_of_view_rad / 2;
    context.strokeStyle = ink.soft;
    context.lineWidth = 1;
    context.setLineDash([3, 3]);
    for (const side of [-0.5, 0.5]) {
        context.beginPath();
        context.arc(at.x, at.y, Math.max(0, range + side * cell.range_m) * camera.scale,
            middle - half, middle + half);
        context.stroke();
    }
    context.setLineDash([]);
}

// Draws rings where the echoes of the chosen reflector are.
function drawChosenReflector() {
    if (!state.reflector) {
        return;
    }
    context.strokeStyle = ink.chosen;
    context.lineWidth = 2.5;
    for (const place of chosenPlaces()) {
        const at = toScreen(place);
        context.beginPath();
        context.arc(at.x, at.y, 8, 0, 2 * Math.PI);
        context.stroke();
    }
}

// Draws crosses on the losses of the cause that is shown, of all objects.
function drawCause() {
    if (state.cause === null || state.object >= 0) {
        return;
    }
    for (const place of placesOfCause()) {
        drawLostMark(context, toScreen(place), 4);
    }
}

// Where the losses of the cause are that is shown.
function placesOfCause() {
    return lossesFor(state.cause).map(({scan, loss}) => lossPlace(scan, loss)).filter(Boolean);
}

function reserveRoom() {
    taken = [];
    for (const {offsetLeft, offsetTop, offsetWidth, offsetHeight} of [control('legend'), control('outside')]) {
        taken.push({x: offsetLeft, y: offsetTop, width: offsetWidth, height: offsetHeight});
    }
    noteBodies();
    eachTarget(state.frame, (scan, target) => takeAround(toScreen(targetPlace(scan, target)), 7));
}

function drawMap() {
    mapSize = fitCanvas(canvas, context);
    if (state.frame < 0) {
        return;
    }
    reserveRoom();
    drawRoadside();
    drawGrid();
    drawRings();
    const objects = objectsOf(state.frame);
    const scans = scansOf(state.frame);
    for (let scan = scans.begin; scan < scans.end; scan++) {
        if (isSensorShown(scan)) {
            drawBeam(scan);
        }
    }
    for (let row = objects.begin; row < objects.end; row++) {
        drawObject(row);
    }
    for (let row = objects.begin; row < objects.end; row++) {
        drawReflectors(row);
    }
    drawRingNumbers();
    drawGridNumbers();
    eachScan(drawMeasuredBodies);
    eachTarget(state.frame, drawEchoes);
    if (state.trail) {
        drawTrail();
    }
    drawTargets();
}

function drawTargets() {
    drawFates();
    drawCause();
    drawChosenReflector();
    if (state.target >= 0) {
        const scan = scanOfTarget(state.frame, state.target);
        drawCellRing(scan, state.target);
        drawContributors(scan, state.target, true);
    }
    eachTarget(state.frame, (scan, target) => {
        if (target !== state.target) {
            drawTarget(scan, target);
        }
    });
    if (state.target >= 0) {
        drawTarget(scanOfTarget(state.frame, state.target), state.target); // over all others
        labelContributors(state.target);
    } else {
        labelFates();
        labelAge();
    }
    labelObjects();
    tellOutside();
}

// Says how many targets lie beyond the edges of the map; a click brings them into view.
function tellOutside() {
    let count = 0;
    eachTarget(state.frame, (scan, target) => {
        count += onScreen(toScreen(targetPlace(scan, target)), 0) ? 0 : 1;
    });
    control('outside').hidden = count === 0;
    setText(control('outside'), `${plural(count, 'target')} off the map`);
}
