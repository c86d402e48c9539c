// What the chosen object, reflector or sensor did over the whole scene: plots over time of
// range, range rate, azimuth, level and count, with the reasons of the losses in their gaps.

const overTimePlots = [
    {title: 'range m', value: target => column('target_range_m')[target]},
    {title: 'rate m/s', value: (target, scan) => rateOf(scan, target, state.rates === 'compensated')},
    {title: 'azimuth °, from the heading',
        value: (target, scan) => vehicleAzimuth(scan, column('target_azimuth_rad')[target]) * degrees},
    {title: 'level dB', value: target => column('target_amplitude_db')[target]},
    {title: 'count'},
];
const notMeasured = 'not measured';
const overTimeMargin = {left: 38, right: 14, top: 14, bottom: 18, between: 16};

const overTimeCanvas = document.getElementById('series');
const overTimeContext = overTimeCanvas.getContext('2d');

let series = {key: '', points: [], counts: [], gaps: []};
let seriesDrawn = '';

function plottedSensor() {
    return control('plotted').value;
}

function isPlotted(scan) {
    return isSensorShown(scan) && (plottedSensor() === '' || sensorOf(scan).name === plottedSensor());
}

// True if the subject has a part in the target.
function isOfSubject(target, subject) {
    if (subject.object < 0) {
        return true;
    }
    const objects = column('contributor_object');
    const reflectors = column('contributor_reflector');
    const {begin, end} = contributorsOf(target);
    for (let i = begin; i < end; i++) {
        if (objects[i] === subject.object && (subject.reflector < 0 || reflectors[i] === subject.reflector)) {
            return true;
        }
    }
    return false;
}

// Counts the echoes of the subject that a pattern lost for each reason. Echoes by way of a mirror count
// only if no others are lost.
function countReasons(pattern, subject) {
    const own = new Map();
    const mirrored = new Map();
    const begin = starts('pattern_items');
    for (let i = begin[pattern]; i < begin[pattern + 1]; i++) {
        if (subject.reflector < 0 || column('item_reflector')[i] === subject.reflector) {
            const counts = isGhostPath(column('item_path')[i]) ? mirrored : own;
            const reason = column('item_reason')[i];
            counts.set(reason, (counts.get(reason) || 0) + 1);
        }
    }
    return own.size > 0 ? own : mirrored;
}

// The same counts for all plotted scans of a frame.
function frameReasons(frame, subject) {
    const counts = new Map();
    eachPlotted(frame, scan => eachFate(scan, (object, pattern) => {
        if (object === subject.object) {
            if (!subject.patterns.has(pattern)) {
                subject.patterns.set(pattern, countReasons(pattern, subject));
            }
            subject.patterns.get(pattern).forEach((count, reason) => counts.set(reason, (counts.get(reason) || 0) + count));
        }
    }));
    return [...counts].sort((a, b) => a[0] - b[0]).map(([reason, count]) => ({...head.reasons[reason], count}));
}

// The reasons why a frame has no target of the subject, with counts or without: those of echoes that could
// have been received, or if there are none those of geometry.
function reasonOfGap(frame, subject, counted) {
    const scans = scansOf(frame);
    const plotted = [];
    eachPlotted(frame, scan => plotted.push(scan));
    if (plotted.length === 0) {
        return scans.end > scans.begin ? 'sensor switched off' : 'no sensor';
    }
    if (!plotted.some(scan => column('scan_measured')[scan])) {
        return notMeasured;
    }
    if (subject.object < 0) {
        return 'no target';
    }
    if (subject.object === head.scenes[state.scene].ego) {
        return 'the ego carries the sensors';
    }
    if (hasObjects && objectRow(frame, subject.object) < 0) {
        return 'not in the scene';
    }
    if (!column('frame_account')[frame]) {
        return 'no account of losses';
    }
    const reasons = frameReasons(frame, subject);
    const notable = reasons.filter(one => one.notable);
    return (notable.length > 0 ? notable : reasons)
        .map(one => (counted ? `${one.count} ` : '') + words(one.name)).join(', ') || 'no echo';
}

// Visits the scans of a frame that are plotted.
function eachPlotted(frame, visit) {
    const {begin, end} = scansOf(frame);
    for (let scan = begin; scan < end; scan++) {
        if (isPlotted(scan)) {
            visit(scan);
        }
    }
}

function addScanToSeries(built, row, scan, subject) {
    const {begin, end} = targetsOf(scan);
    let count = 0;
    for (let target = begin; target < end; target++) {
        if (isOfSubject(target, subject)) {
            built.points.push({row, scan, target});
            count++;
        }
    }
    return count;
}

// Adds a frame without targets to the gap before it if that has the same reason, else begins a gap. A frame
// in which no sensor measured begins none.
function addToGaps(gaps, row, reason) {
    const last = gaps[gaps.length - 1];
    if (last && last.to === row - 1 && (last.reason === reason || reason === notMeasured)) {
        last.to = row;
    } else if (reason !== notMeasured) {
        gaps.push({from: row, to: row, reason});
    }
}

function buildSeries(key) {
    const subject = {object: state.object, reflector: state.reflector ? names.indexOf(state.reflector) : -1,
        patterns: new Map()};
    const built = {key, subject, points: [], counts: [], gaps: []};
    sceneFrames[state.scene].forEach((frame, row) => {
        let count = 0;
        eachPlotted(frame, scan => { count += addScanToSeries(built, row, scan, subject); });
        built.counts.push(count);
        if (count === 0) {
            addToGaps(built.gaps, row, reasonOfGap(frame, subject, false));
        }
    });
    return built;
}

function seriesOfSubject() {
    const key = [state.scene, state.object, state.reflector, plottedSensor(),
        ...switchedOff.sensor].join('|');
    if (series.key !== key) {
        series = buildSeries(key);
    }
    return series;
}

// The panel of one plot, and its scale.
function overTimePanel(size, i) {
    const height = (size.height - overTimeMargin.top - overTimeMargin.bottom -
        overTimeMargin.between * (overTimePlots.length - 1)) / overTimePlots.length;
    const top = overTimeMargin.top + i * (height + overTimeMargin.between);
    return {top, height, left: overTimeMargin.left, right: size.width - overTimeMargin.right};
}

function timeSpan() {
    const frames = sceneFrames[state.scene];
    const times = column('frame_time_s');
    const from = times[frames[0]];
    return {from, span: Math.max(1e-6, times[frames[frames.length - 1]] - from)};
}

function timePlace(panelOf, row) {
    const {from, span} = timeSpan();
    const time = column('frame_time_s')[sceneFrames[state.scene][row]];
    return panelOf.left + (panelOf.right - panelOf.left) * (time - from) / span;
}

function scaleOf(values) {
    let low = Infinity;
    let high = -Infinity;
    for (const value of values) {
        low = Math.min(low, value);
        high = Math.max(high, value);
    }
    const room = high > low ? 0.06 * (high - low) : 1;
    return high >= low ? {low: low - room, high: high + room} : {low: 0, high: 1};
}

function drawScale(drawing, panelOf, title, scale) {
    const step = Math.max(title === 'count' ? 1 : 0, roundStep(scale.high - scale.low, 3));
    for (let value = Math.ceil(scale.low / step) * step; value <= scale.high; value += step) {
        const y = panelOf.top + panelOf.height * (scale.high - value) / (scale.high - scale.low);
        plotRule(drawing, {x: panelOf.left, y}, {x: panelOf.right, y}, false);
        plotText(drawing, String(Number(value.toPrecision(4))), panelOf.left - 4, y, 'right');
    }
    plotText(drawing, title, panelOf.left, panelOf.top - 7, 'left');
}

function drawGap(drawing, size, gap) {
    const panelOf = overTimePanel(size, 0);
    const from = timePlace(panelOf, gap.from);
    const to = Math.max(from + 1, timePlace(panelOf, Math.min(series.counts.length - 1, gap.to + 1)));
    drawing.fillStyle = ink.grid;
    drawing.fillRect(from, panelOf.top, Math.max(1, to - from - 1), size.height - overTimeMargin.bottom - panelOf.top);
    drawing.fillStyle = ink.soft;
    drawing.font = mapFont(11);
    const width = drawing.measureText(gap.reason).width;
    drawing.textAlign = 'center';
    drawing.textBaseline = 'middle';
    const middle = {x: (from + to) / 2, y: panelOf.top + panelOf.height / 2};
    if (width < to - from - 4) {
        drawing.fillText(gap.reason, middle.x, middle.y);
    } else if (to - from >= 12) {
        drawUpright(drawing, gap.reason, {x: middle.x, y: size.height - overTimeMargin.bottom - 14});
    }
}

// Writes a text from a place upward.
function drawUpright(drawing, text, at) {
    drawing.save();
    drawing.translate(at.x, at.y);
    drawing.rotate(-Math.PI / 2);
    drawing.textAlign = 'left';
    drawing.fillText(text, 0, 0);
    drawing.restore();
}

// Draws the points of one plot, none twice at one place.
function drawSeries(drawing, size, i) {
    const panelOf = overTimePanel(size, i);
    const {value, title} = overTimePlots[i];
    const values = value ? series.points.map(({target, scan}) => value(target, scan)) : [0, ...series.counts];
    const scale = scaleOf(values);
    const place = number => panelOf.top + panelOf.height * (scale.high - number) / (scale.high - scale.low);
    drawScale(drawing, panelOf, title, scale);
    const used = new Set();
    const dot = (x, y, colour) => {
        const pixel = Math.round(x) * 4096 + Math.round(y);
        if (!used.has(pixel)) {
            used.add(pixel);
            drawing.fillStyle = colour;
            drawing.fillRect(x - 1.25, y - 1.25, 2.5, 2.5);
        }
    };
    if (value) {
        series.points.forEach(({row, scan, target}, at) =>
            dot(timePlace(panelOf, row), place(values[at]), colourOf(scan, target)));
    } else {
        series.counts.forEach((count, row) => dot(timePlace(panelOf, row), place(count), ink.soft));
    }
}

function drawTimeAxis(drawing, size) {
    const {from, span} = timeSpan();
    const panelOf = overTimePanel(size, overTimePlots.length - 1);
    const step = roundStep(span, 5);
    const start = head.scenes[state.scene].start_s + from;
    for (let time = Math.ceil(start / step) * step; time <= start + span; time += step) {
        const x = panelOf.left + (panelOf.right - panelOf.left) * (time - start) / span;
        plotText(drawing, `${Number(time.toPrecision(4))} s`, x, size.height - 8, 'center');
    }
}

function drawOverTime() {
    seriesOfSubject();
    const look = [series.key, overTimeCanvas.clientWidth, overTimeCanvas.clientHeight, isDark(), state.colour,
        state.effect, state.rates].join('|');
    if (seriesDrawn !== look) {
        seriesDrawn = look;
        const size = fitCanvas(overTimeCanvas, overTimeContext);
        series.gaps.forEach(gap => drawGap(overTimeContext, size, gap));
        overTimePlots.forEach((_, i) => drawSeries(overTimeContext, size, i));
        drawTimeAxis(overTimeContext, size);
    }
    const panelOf = overTimePanel({width: overTimeCanvas.clientWidth, height: overTimeCanvas.clientHeight}, 0);
    control('cursor').style.left = timePlace(panelOf, state.row) + 'px';
}

function subjectTitle() {
    return state.object < 0 ? plottedSensor() || 'all targets'
        : state.reflector ? `${state.reflector} of ${names[state.object]}` : names[state.object];
}

function fillOverTime() {
    setText(control('subject'), subjectTitle());
    showLanes();
    drawOverTime();
}

// The row whose time lies nearest to a place in the plots.
function rowOfPlace(x) {
    const panelOf = overTimePanel({width: overTimeCanvas.clientWidth, height: overTimeCanvas.clientHeight}, 0);
    const {from, span} = timeSpan();
    const part = (x - panelOf.left) / (panelOf.right - panelOf.left);
    const frames = sceneFrames[state.scene];
    const row = rowAt(frames, from + part * span);
    const next = Math.min(row + 1, frames.length - 1);
    return x - timePlace(panelOf, row) < timePlace(panelOf, next) - x ? row : next;
}

function overTimeWords(row) {
    const frame = sceneFrames[state.scene][row];
    return `frame ${frameNumber(frame)}: ` + (series.counts[row] > 0 ? plural(series.counts[row], 'target')
        : reasonOfGap(frame, series.subject, true));
}

function connectOverTime() {
    panes.get('over-time').fill = fillOverTime;
    for (const name of ['', ...sensorNames]) {
        const option = make('option', name || 'all sensors');
        option.value = name;
        control('plotted').append(option);
    }
    control('plotted').addEventListener('change', refresh);
    [['last-event', -1], ['next-event', 1]].forEach(([id, step]) => control(id).addEventListener('click', () => stepEvent(step)));
    overTimeCanvas.addEventListener('click', event => {
        setPlaying(false);
        showRow(rowOfPlace(event.offsetX));
    });
    overTimeCanvas.addEventListener('pointermove', event =>
        showTip(overTimeWords(rowOfPlace(event.offsetX)), event.clientX, event.clientY));
    overTimeCanvas.addEventListener('pointerleave', hideTip);
    new ResizeObserver(() => state.pane === 'over-time' && fillOverTime()).observe(overTimeCanvas);
}
