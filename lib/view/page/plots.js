// The side plots: the sensors' measurements in polar values. Targets are symbols, the exact echoes
// behind them dots, resolution cells boxes. Azimuths are in the vehicle's frame, from its heading.

// axes: the zoomed ranges of the axes; null: the whole plot.
const plots = {
    azimuth: {canvas: document.getElementById('azimuths'), unit: '°', hits: [], axes: null},
    rate: {canvas: document.getElementById('speeds'), unit: 'm/s', hits: [], axes: null},
};

const degrees = 180 / Math.PI;
const leastCell = 3; // px: the outline of a smaller box would be as wide as the box
const plotMargin = {left: 30, right: 14, top: 8, bottom: 30};

function roundStep(span, parts) {
    const wanted = span / parts;
    const power = Math.pow(10, Math.floor(Math.log10(wanted)));
    return [1, 2, 5, 10].map(factor => factor * power).find(step => step >= wanted);
}

// The largest range, azimuth and range rate of the whole stream, so that the axes do not change
// from frame to frame.
function plotLimits() {
    const range = Math.max(extremes('target_range_m', true).high, extremes('contributor_range_m', true).high);
    const echoes = state.rates === 'compensated' ? 0 : extremes('contributor_range_rate_mps', true).high;
    return {
        range: Math.max(5, range) * 1.08,
        azimuth: Math.min(180, Math.max(10, 10 * Math.ceil(widestAzimuth() * degrees / 10 - 0.01))),
        rate: Math.max(2, state.fastest, echoes) * 1.1,
    };
}

// The largest angle from the vehicle's heading that a field of view covers or a target has.
function widestAzimuth() {
    let widest = 0;
    for (const sensor of head.sensors) {
        const reach = Math.abs(wrap(sensor.mount_yaw_rad)) + sensor.field_of_view_rad / 2;
        widest = Math.max(widest, Math.min(Math.PI, reach));
    }
    const azimuths = column('target_azimuth_rad');
    for (let scan = 0; scan < column('scan_targets').length; scan++) {
        const {begin, end} = targetsOf(scan);
        for (let target = begin; target < end; target++) {
            widest = Math.max(widest, Math.abs(vehicleAzimuth(scan, azimuths[target])));
        }
    }
    return widest;
}

function wrap(angle) {
    return angle - 2 * Math.PI * Math.round(angle / (2 * Math.PI));
}

// An azimuth of a sensor's, from its boresight, as one from the vehicle's heading.
function vehicleAzimuth(scan, azimuth) {
    return wrap(azimuth + sensorOf(scan).mount_yaw_rad);
}

function wholeAxes(kind) {
    const limits = state.limits;
    return kind === 'azimuth' ? {left: limits.azimuth, right: -limits.azimuth, bottom: 0, top: limits.range}
        : {left: -limits.rate, right: limits.rate, bottom: 0, top: limits.range};
}

function plotAxes(kind) {
    return plots[kind].axes || wholeAxes(kind);
}

// The values at a place in a plot.
function plotValues(kind, x, y) {
    const {clientWidth: width, clientHeight: height} = plots[kind].canvas;
    const axes = plotAxes(kind);
    const across = (x - plotMargin.left) / (width - plotMargin.left - plotMargin.right);
    const up = (height - plotMargin.bottom - y) / (height - plotMargin.top - plotMargin.bottom);
    return {x: axes.left + across * (axes.right - axes.left), range: axes.bottom + up * (axes.top - axes.bottom)};
}

// Zooms a plot around a place, which stays where it is, out to the whole plot at most.
function zoomPlot(kind, factor, x, y) {
    const at = plotValues(kind, x, y);
    const {left, right, bottom, top} = plotAxes(kind);
    const about = (value, middle) => middle + (value - middle) / factor;
    const axes = {left: about(left, at.x), right: about(right, at.x),
        bottom: about(bottom, at.range), top: about(top, at.range)};
    const whole = wholeAxes(kind);
    const share = (axes.right - axes.left) / (whole.right - whole.left);
    plots[kind].axes = share >= 1 ? null : share > 1e-4 ? axes : plots[kind].axes;
    redraw();
}

// Moves a plot that is zoomed.
function panPlot(kind, dx, dy) {
    const {axes} = plots[kind];
    if (axes) {
        const from = plotValues(kind, 0, 0);
        const to = plotValues(kind, dx, dy);
        const [across, up] = [from.x - to.x, from.range - to.range];
        plots[kind].axes = {left: axes.left + across, right: axes.right + across,
            bottom: axes.bottom + up, top: axes.top + up};
        redraw();
    }
}

function showWholePlot(kind) {
    plots[kind].axes = null;
    redraw();
}

function connectPlots() {
    for (const [kind, plot] of Object.entries(plots)) {
        connectPointers(plot.canvas, {pan: (dx, dy) => panPlot(kind, dx, dy),
            zoom: (factor, x, y) => zoomPlot(kind, factor, x, y), click: at => clickPlot(plot, at)});
        plot.canvas.addEventListener('dblclick', () => showWholePlot(kind));
    }
}

function plotPlace(size, axes, x, range) {
    const width = size.width - plotMargin.left - plotMargin.right;
    const height = size.height - plotMargin.top - plotMargin.bottom;
    return {
        x: plotMargin.left + width * (x - axes.left) / (axes.right - axes.left),
        y: size.height - plotMargin.bottom - height * (range - axes.bottom) / (axes.top - axes.bottom),
    };
}

function plotText(drawing, text, x, y, align) {
    drawing.fillStyle = ink.soft;
    drawing.font = mapFont(11);
    drawing.textAlign = align;
    drawing.textBaseline = 'middle';
    drawing.fillText(text, x, y);
}

function plotRule(drawing, from, to, strong) {
    drawing.strokeStyle = strong ? ink.edge : ink.grid;
    drawing.lineWidth = 1;
    drawing.beginPath();
    drawing.moveTo(from.x, from.y);
    drawing.lineTo(to.x, to.y);
    drawing.stroke();
}

// A number at an axis, with as many digits as the step of the axis needs.
function tickText(value, step) {
    return round(value, Math.max(0, -Math.floor(Math.log10(step) + 1e-9))).replace('-', '−');
}

function drawAxes(drawing, size, axes, unit) {
    const span = Math.abs(axes.right - axes.left);
    const step = span === 180 ? 45 : roundStep(span, 4);
    const low = Math.min(axes.left, axes.right);
    const high = Math.max(axes.left, axes.right);
    for (let x = Math.ceil(low / step) * step; x <= high; x += step) {
        const at = plotPlace(size, axes, x, axes.bottom);
        plotRule(drawing, at, plotPlace(size, axes, x, axes.top), x === 0);
        plotText(drawing, tickText(x, step), at.x, at.y + 11, 'center');
    }
    const stride = roundStep(axes.top - axes.bottom, 4);
    for (let range = Math.ceil(axes.bottom / stride) * stride; range <= axes.top; range += stride) {
        const at = plotPlace(size, axes, axes.left, range);
        plotRule(drawing, at, plotPlace(size, axes, axes.right, range), range === 0);
        plotText(drawing, tickText(range, stride), at.x - 4, at.y, 'right');
    }
    const middle = plotPlace(size, axes, (axes.left + axes.right) / 2, axes.bottom);
    plotText(drawing, unit === '°' ? '° from the vehicle’s heading'
        : state.rates === 'raw' ? 'm/s, receding is right' : 'm/s over ground',
        middle.x, size.height - 7, 'center');
}

function plotTarget(plot, kind, drawing, size, axes, scan, target) {
    const compensated = state.rates === 'compensated';
    const x = kind === 'azimuth' ? vehicleAzimuth(scan, column('target_azimuth_rad')[target]) * degrees
        : rateOf(scan, target, compensated);
    const range = column('target_range_m')[target];
    if (x === null || (x - axes.left) * (x - axes.right) > 0 || range < axes.bottom || range > axes.top) {
        return;
    }
    const at = plotPlace(size, axes, x, range);
    const chosen = target === state.target;
    drawTargetSymbol(drawing, sensorStyle(scan), at.x, at.y, chosen ? 7.5 : 5, colourOf(scan, target),
        kindOf(target));
    if (chosen) {
        drawing.beginPath();
        drawing.arc(at.x, at.y, 11, 0, 2 * Math.PI);
        drawing.strokeStyle = ink.chosen;
        drawing.stroke();
    }
    plot.hits.push({x: at.x, y: at.y, target});
}

// The resolution cell around the target's leader: echoes inside the box become one target.
function plotCell(kind, drawing, size, axes, scan, target) {
    const cell = cellOf(scan);
    const leader = leaderOf(target);
    if (!cell || kind !== 'rate' || state.rates === 'compensated') {
        return;
    }
    const rate = column('contributor_range_rate_mps')[leader];
    const range = column('contributor_range_m')[leader];
    const low = plotPlace(size, axes, rate - cell.range_rate_mps / 2, range - cell.range_m / 2);
    const high = plotPlace(size, axes, rate + cell.range_rate_mps / 2, range + cell.range_m / 2);
    if (high.x - low.x >= leastCell && low.y - high.y >= leastCell) {
        drawing.strokeStyle = ink.edge;
        drawing.lineWidth = 1;
        drawing.strokeRect(low.x, high.y, high.x - low.x, low.y - high.y);
    }
}

function plotEchoes(kind, drawing, size, axes, scan, target) {
    const {begin, end} = contributorsOf(target);
    for (let i = begin; i < end && (kind === 'azimuth' || state.rates === 'raw'); i++) {
        const x = kind === 'azimuth' ? vehicleAzimuth(scan, column('contributor_azimuth_rad')[i]) * degrees
            : column('contributor_range_rate_mps')[i];
        const at = plotPlace(size, axes, x, column('contributor_range_m')[i]);
        drawing.fillStyle = ink.soft;
        drawing.fillRect(at.x - 1.5, at.y - 1.5, 3, 3);
    }
}

function drawPlot(kind) {
    const plot = plots[kind];
    if (plot.canvas.parentElement.hidden) {
        return;
    }
    const drawing = plot.canvas.getContext('2d');
    const size = fitCanvas(plot.canvas, drawing);
    const axes = plotAxes(kind);
    plot.hits = [];
    drawAxes(drawing, size, axes, plot.unit);
    if (state.frame < 0) {
        return;
    }
    const top = plotPlace(size, axes, axes.left, axes.top);
    const end = plotPlace(size, axes, axes.right, axes.bottom);
    drawing.save();
    drawing.beginPath();
    drawing.rect(top.x - 6, top.y - 6, end.x - top.x + 12, end.y - top.y + 12);
    drawing.clip();
    eachTarget(state.frame, (scan, target) => {
        plotCell(kind, drawing, size, axes, scan, target);
        plotEchoes(kind, drawing, size, axes, scan, target);
    });
    const order = [[], []]; // the chosen one over all others
    eachTarget(state.frame, (scan, target) => order[Number(target === state.target)].push([scan, target]));
    order.flat().forEach(one => plotTarget(plot, kind, drawing, size, axes, ...one));
    drawing.restore();
}

function drawPlots() {
    drawPlot('azimuth');
    drawPlot('rate');
}
