// Colours and marks, in light and dark: a target's symbol by its sensor and by what it is an echo
// of, and the cross of a lost echo. Shapes and colours come from the page's head (lib/view/view_marks.h).

let ink = {};

function isDark() {
    return document.documentElement.classList.contains('dark');
}

function readInk() {
    const style = getComputedStyle(document.documentElement);
    ink = {palette: isDark() ? head.dark : head.light};
    for (const name of ['paper', 'ink', 'soft', 'faint', 'grid', 'body', 'edge', 'ego', 'chosen', 'lost']) {
        ink[name] = style.getPropertyValue('--' + name).trim();
    }
}

const fontFamily = 'system-ui, "DejaVu Sans", sans-serif';

function mapFont(size, bold) {
    return `${bold ? '700 ' : ''}${size}px ${fontFamily}`;
}

// Gives a canvas the pixels of its place on the screen; returns its size in CSS pixels.
function fitCanvas(element, drawing) {
    const ratio = window.devicePixelRatio || 1;
    const width = element.clientWidth;
    const height = element.clientHeight;
    if (element.width !== Math.round(width * ratio) || element.height !== Math.round(height * ratio)) {
        element.width = Math.round(width * ratio);
        element.height = Math.round(height * ratio);
    }
    drawing.setTransform(ratio, 0, 0, ratio, 0, 0);
    drawing.clearRect(0, 0, width, height);
    return {width, height};
}

// Colours of numbers: range rates from blue through grey to red, amplitudes from dark to bright.
function mix(from, to, part) {
    const channel = i => Math.round(from[i] + part * (to[i] - from[i]));
    return `rgb(${channel(0)},${channel(1)},${channel(2)})`;
}

function rateColour(rate) {
    if (rate === null) {
        return ink.edge;
    }
    const part = Math.max(-1, Math.min(1, rate / state.rateScale));
    const neutral = isDark() ? [190, 190, 190] : [120, 120, 120];
    const blue = isDark() ? [80, 170, 255] : [0, 90, 200];
    const red = isDark() ? [255, 120, 60] : [205, 60, 0];
    return part < 0 ? mix(neutral, blue, Math.sqrt(-part)) : mix(neutral, red, Math.sqrt(part));
}

function amplitudeColour(level) {
    const {low, high} = state.amplitudes;
    const part = high > low ? (level - low) / (high - low) : 1;
    return isDark() ? mix([70, 90, 150], [255, 235, 90], part) : mix([215, 175, 20], [20, 40, 110], part);
}

const objectOrders = new Map();

// Objects take colours in the order of their first targets, so that few objects share a colour.
function objectOrder(number) {
    let order = objectOrders.get(number);
    if (order === undefined) {
        order = new Map();
        for (const frame of sceneFrames[number]) {
            const {begin, end} = scansOf(frame);
            for (let target = starts('scan_targets')[begin]; target < starts('scan_targets')[end]; target++) {
                const object = objectOfTarget(target);
                if (!order.has(object)) {
                    order.set(object, order.size);
                }
            }
        }
        objectOrders.set(number, order);
    }
    return order;
}

function objectColour(object) {
    const place = objectOrder(state.scene).get(object);
    return place === undefined ? ink.edge : ink.palette[place % ink.palette.length];
}

// The colour of a sensor's symbol outside the map: its own where targets are coloured by sensor,
// else grey.
function sensorColour(style) {
    const own = state.colour === 'sensor' && state.effect < 0;
    return own ? ink.palette[style % ink.palette.length] : ink.soft;
}

function colourOf(scan, target) {
    if (state.effect >= 0) {
        return effectsOf(target).includes(state.effect) ? ink.palette[1] : ink.edge;
    }
    switch (state.colour) {
    case 'object':
        return objectColour(objectOfTarget(target));
    case 'rate':
        return rateColour(rateOf(scan, target, state.rates === 'compensated'));
    case 'amplitude':
        return amplitudeColour(column('target_amplitude_db')[target]);
    case 'path':
        return ink.palette[column('contributor_path')[leaderOf(target)] % ink.palette.length];
    default:
        return ink.palette[sensorStyle(scan) % ink.palette.length];
    }
}

function tracePolygon(drawing, x, y, radius, corners, inner, turn) {
    const steps = inner ? 2 * corners : corners;
    for (let i = 0; i < steps; i++) {
        const reach = inner && i % 2 ? radius * inner : radius;
        const angle = turn - Math.PI / 2 + 2 * Math.PI * i / steps;
        drawing.lineTo(x + reach * Math.cos(angle), y + reach * Math.sin(angle));
    }
    drawing.closePath();
}

function traceTargetShape(drawing, style, x, y, radius) {
    const {corners, inner, turn_rad: turn, size} = head.shapes[style % head.shapes.length];
    drawing.beginPath();
    if (corners === 0) {
        drawing.arc(x, y, size * radius, 0, 2 * Math.PI);
    } else {
        tracePolygon(drawing, x, y, size * radius, corners, inner, turn);
    }
}

// Draws the traced shape as that of a true target, from the other stream: an outline.
function drawTruth(drawing) {
    drawing.lineWidth = 1.2;
    drawing.strokeStyle = ink.ink;
    drawing.stroke();
}

// Draws the traced circle hollow, so that another sensor's symbol at the same place shows through.
function drawRing(drawing, radius, colour) {
    drawing.lineWidth = radius * 0.36 + 2;
    drawing.strokeStyle = ink.paper;
    drawing.stroke();
    drawing.lineWidth = radius * 0.36;
    drawing.strokeStyle = colour;
    drawing.stroke();
}

// Draws the traced shape as a ghost's: hollow, with a dashed outline.
function drawGhost(drawing, colour) {
    drawing.fillStyle = ink.paper;
    drawing.fill();
    drawing.lineWidth = 1.8;
    drawing.strokeStyle = colour;
    drawing.setLineDash([3, 2]);
    drawing.stroke();
    drawing.setLineDash([]);
}

// Draws a false alarm: an asterisk, which covers nothing.
function drawFalseAlarm(drawing, x, y, radius, colour) {
    for (const [width, stroke] of [[radius * 0.3 + 2.4, ink.paper], [radius * 0.3, colour]]) {
        drawing.lineWidth = width;
        drawing.strokeStyle = stroke;
        drawing.beginPath();
        for (let arm = 0; arm < 3; arm++) {
            const dx = 1.1 * radius * Math.cos(arm * Math.PI / 3 + Math.PI / 6);
            const dy = 1.1 * radius * Math.sin(arm * Math.PI / 3 + Math.PI / 6);
            drawing.moveTo(x - dx, y - dy);
            drawing.lineTo(x + dx, y + dy);
        }
        drawing.stroke();
    }
}

// Draws clutter: three dots, as of gravel.
function drawClutter(drawing, x, y, radius, colour) {
    drawing.fillStyle = colour;
    drawing.lineWidth = 1.2;
    drawing.strokeStyle = ink.paper;
    for (const [dx, dy] of [[0, -0.6], [-0.65, 0.5], [0.65, 0.5]]) {
        drawing.beginPath();
        drawing.arc(x + dx * radius, y + dy * radius, 0.42 * radius, 0, 2 * Math.PI);
        drawing.fill();
        drawing.stroke();
    }
}

// Draws a bolt at the upper right of a symbol that interference disturbed.
function drawBolt(drawing, x, y, radius) {
    drawing.beginPath();
    for (const [dx, dy] of [[1.6, -1.9], [0.9, -1.0], [1.5, -1.0], [0.9, -0.1]]) {
        drawing.lineTo(x + dx * radius, y + dy * radius);
    }
    drawing.lineJoin = 'bevel';
    drawing.lineWidth = 3.6;
    drawing.strokeStyle = ink.paper;
    drawing.stroke();
    drawing.lineWidth = 1.6;
    drawing.strokeStyle = ink.lost;
    drawing.stroke();
    drawing.lineJoin = 'miter';
}

// Draws a target; kind is that of kindOf, or "truth".
function drawTargetSymbol(drawing, style, x, y, radius, colour, kind) {
    if (kind === 'false_alarm') {
        drawFalseAlarm(drawing, x, y, radius, colour);
        return;
    }
    if (kind === 'clutter') {
        drawClutter(drawing, x, y, radius, colour);
        return;
    }
    traceTargetShape(drawing, style, x, y, radius);
    if (kind === 'truth') {
        drawTruth(drawing);
    } else if (kind === 'ghost') {
        drawGhost(drawing, colour);
    } else if (head.shapes[style % head.shapes.length].corners === 0) {
        drawRing(drawing, radius, colour);
    } else {
        drawing.fillStyle = colour;
        drawing.fill();
        drawing.lineWidth = 1.2;
        drawing.strokeStyle = ink.paper;
        drawing.stroke();
    }
}

// Marks a lost echo with a cross.
function drawLostMark(drawing, at, radius) {
    drawing.strokeStyle = ink.lost;
    drawing.lineWidth = 2;
    drawing.beginPath();
    for (const side of [-1, 1]) {
        drawing.moveTo(at.x - radius, at.y - side * radius);
        drawing.lineTo(at.x + radius, at.y + side * radius);
    }
    drawing.stroke();
}
