// Targets on the map: fields of view, symbols with their speeds and trails, and the echoes that made them.

function drawBeams() {
    eachScan(drawBeam);
}

function beamMeanings() {
    return [meaning(lineMark(1.2, [[1, 8, 5, 8], [7, 8, 11, 8], [13, 8, 17, 8]]), 'field of view')];
}

function drawBeam(scan) {
    const sensor = sensorOf(scan);
    const at = toScreen(scanPlace(scan, 0, 0));
    const middle = screenAngle(column('scan_yaw_rad')[scan]);
    const half = sensor.field_of_view_rad / 2;
    const colour = ink.palette[sensorStyle(scan) % ink.palette.length];
    pen.beginPath();
    pen.moveTo(at.x, at.y);
    pen.arc(at.x, at.y, sensor.range_max_m * camera.scale, middle - half, middle + half);
    pen.closePath();
    pen.globalAlpha = 0.035;
    pen.fillStyle = colour;
    pen.fill();
    pen.globalAlpha = 0.55;
    pen.strokeStyle = colour;
    pen.lineWidth = 1;
    pen.setLineDash(column('scan_measured')[scan] ? [6, 4] : [1, 5]);
    pen.stroke();
    pen.setLineDash([]);
    pen.globalAlpha = 1;
}

// Draws the echoes in targets as dots.
function drawEchoes() {
    if (camera.scale >= 3) {
        eachTarget(state.frame, drawEchoesIn);
    }
}

function echoMeanings() {
    return pathsSeen.length > 0 ? [meaning(dotMark(ink.ink), 'echo in a target')] : [];
}

function drawEchoesIn(scan, target) {
    const {begin, end} = contributorsOf(target);
    for (let i = begin; i < end; i++) {
        const at = toScreen(contributorPlace(scan, i));
        if (onScreen(at, 2)) {
            drawDot(at, 2.2, ink.ink);
        }
    }
}

// Draws the targets of the last half second, the paler the older.
function drawTrail() {
    if (!state.trail) {
        return;
    }
    const frames = sceneFrames[state.scene];
    const times = column('frame_time_s');
    const now = times[state.frame];
    for (let at = state.row - 1; state.ego && at >= 0 && times[frames[at]] > now - 0.5; at--) {
        pen.globalAlpha = 0.45 * (1 - (now - times[frames[at]]) / 0.5);
        eachTarget(frames[at], (scan, target) => {
            drawDot(toScreen(targetPlace(scan, target)), 2.2, colourOf(scan, target));
        });
    }
    pen.globalAlpha = 1;
}

function trailMeanings() {
    const pale = drawing => {
        drawing.globalAlpha = 0.4;
        dotMark(sensorColour(0))(drawing);
    };
    return state.trail ? [meaning(pale, 'targets of the last 0.5 s')] : [];
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
        drawFoldedRate(pen, from, to, colour);
        return;
    }
    pen.strokeStyle = colour;
    pen.lineWidth = 1.6;
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

// Draws the chosen target over all others.
function drawTargets() {
    eachTarget(state.frame, (scan, target) => {
        if (target !== state.target) {
            drawTarget(scan, target);
        }
    });
    if (state.target >= 0) {
        drawTarget(scanOfTarget(state.frame, state.target), state.target);
    }
}

function drawTarget(scan, target) {
    pen.beginPart('target', () => targetWords(scan, target));
    const at = toScreen(targetPlace(scan, target));
    const colour = colourOf(scan, target);
    drawRate(scan, target, colour);
    drawTargetSymbol(pen, sensorStyle(scan), at.x, at.y, target === state.target ? 9.5 : 7, colour,
        kindOf(target));
    if (isInterfered(target)) {
        drawBolt(pen, at.x, at.y, 6);
    }
    if (target === state.target) {
        pen.beginPath();
        pen.arc(at.x, at.y, 15, 0, 2 * Math.PI);
        pen.strokeStyle = ink.chosen;
        pen.lineWidth = 2;
        pen.stroke();
    }
    pen.endPart();
}

// Draws the cell of the chosen target and the echoes in it.
function drawChosenEchoes() {
    if (state.target >= 0) {
        const scan = scanOfTarget(state.frame, state.target);
        drawCellRing(scan, state.target);
        drawContributors(scan, state.target, true);
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
        pen.strokeStyle = colour;
        pen.globalAlpha = strong ? 0.9 : 0.6;
        pen.lineWidth = 1 + 3 * weights[i];
        line(from, at);
        pen.globalAlpha = 1;
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
    pen.strokeStyle = ink.soft;
    pen.lineWidth = 1.2;
    pen.setLineDash([2, 4]);
    line(toScreen(contributorPlace(scan, i)), toScreen(spotPlace(measuredBox(scan, row), spot)));
    pen.setLineDash([]);
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
    pen.strokeStyle = ink.soft;
    pen.lineWidth = 1;
    pen.setLineDash([3, 3]);
    for (const side of [-0.5, 0.5]) {
        pen.beginPath();
        pen.arc(at.x, at.y, Math.max(0, range + side * cell.range_m) * camera.scale,
            middle - half, middle + half);
        pen.stroke();
    }
    pen.setLineDash([]);
}

function labelTargets() {
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; scan < end; scan++) {
        for (const {target, number} of shownTargetsFrom(scan, state.object).slice(0, 12)) {
            putLabel(String(number), toScreen(targetPlace(scan, target)), colourOf(scan, target), true);
        }
    }
}

// What the legend tells of targets.

const kindWords = {
    ghost: 'ghost: seen by way of a mirror',
    clutter: 'clutter: an echo of the ground or roadside',
    false_alarm: 'false alarm: nothing but noise',
};

// Kinds of targets besides bodies that the stream has.
function kindMeanings() {
    const kinds = new Set(pathsSeen.map(path => head.kinds[path]));
    return Object.keys(kindWords).filter(kind => kinds.has(kind))
        .map(kind => meaning(symbolMark(0, ink.soft, kind), kindWords[kind]));
}

function effectMeanings() {
    const changes = effect => effectSets.some(set => set.includes(effect));
    const folded = drawing => drawFoldedRate(drawing, {x: 1, y: 8}, {x: 17, y: 8}, ink.soft);
    return [
        ...changes(interferenceEffect) ? [meaning(drawing => drawBolt(drawing, 2, 13, 6), 'disturbed by other radars')] : [],
        ...changes(ambiguityEffect) ? [meaning(folded, 'folded rate: the true one is another')] : []];
}

function colourMeanings() {
    if (state.effect >= 0) {
        const effect = words(head.effects[state.effect]);
        return [meaning(dotMark(ink.palette[1]), `changed by ${effect}`), meaning(dotMark(ink.edge), 'not changed by it')];
    }
    if (state.colour === 'rate') {
        const top = state.rateScale;
        const colours = [-4, -3, -2, -1, 0, 1, 2, 3, 4].map(part => rateColour(top * part / 4));
        return [meaning(barsMark(colours, 0), `approaching ${round(top, 1)} … receding ${round(top, 1)} m/s`)];
    }
    if (state.colour === 'amplitude') {
        const {low, high} = state.amplitudes;
        const colours = [0, 0.25, 0.5, 0.75, 1].map(part => amplitudeColour(low + part * (high - low)));
        return [meaning(barsMark(colours, 0), `amplitude ${round(low, 1)} … ${round(high, 1)} dB`)];
    }
    if (state.colour === 'object') {
        return [meaning(barsMark(ink.palette.slice(0, 3), 1), 'in the colour of its object')];
    }
    return state.colour !== 'path' ? [] : pathsSeen.map(path =>
        meaning(dotMark(ink.palette[path % ink.palette.length]), `path: ${words(head.paths[path])}`));
}

function targetMeanings() {
    const over = state.rates === 'raw' ? '' : ' over ground';
    return [
        ...sensorNames.map((name, i) => meaning(symbolMark(i, sensorColour(i)), `target of ${name}`, i)),
        ...kindMeanings(), ...colourMeanings(),
        meaning(lineMark(1.6, [[1, 8, 17, 8]]), `its radial speed${over}, 0.5 s long`),
        ...effectMeanings()];
}
