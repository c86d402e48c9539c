// Targets on the map: fields of view, symbols with their speeds and trails, and the echoes that made them.

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

function labelTargets() {
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; scan < end; scan++) {
        for (const {target, number} of shownTargetsFrom(scan, state.object).slice(0, 12)) {
            putLabel(String(number), toScreen(targetPlace(scan, target)), colourOf(scan, target), true);
        }
    }
}
