// Labels of the map. Each takes the first free place around the thing it names, if there is one beside
// all other bodies.
let taken = [];
let bodies = []; // boxes around the objects in view

function overlap(box, other) {
    return box.x < other.x + other.width && other.x < box.x + box.width &&
        box.y < other.y + other.height && other.y < box.y + box.height;
}

function isFree(box) {
    return !taken.some(other => overlap(box, other));
}

// The upright box around an object on the screen.
function boundsOf(box) {
    const corners = outlineOf(box).map(toScreen);
    const x = spreadOf(corners, 'x');
    const y = spreadOf(corners, 'y');
    return {x: x.low, y: y.low, width: x.high - x.low, height: y.high - y.low};
}

// Notes where bodies are, but for those that fill little of the box around them, as slanted walls do.
function noteBodies() {
    bodies = [];
    const {begin, end} = objectsOf(state.frame);
    for (let row = begin; row < end; row++) {
        const box = boxOf(row);
        const bounds = boundsOf(box);
        if (isClassShown(row) && bounds.width * bounds.height < 3 * box.length * box.width * camera.scale ** 2) {
            bodies.push(bounds);
        }
    }
}

// True if a label of the thing at a place would lie over another body.
function hidesBody(label, at) {
    return bodies.some(body => overlap(label, body) && !overlap({...at, width: 0, height: 0}, body));
}

function takeAround(at, radius) {
    taken.push({x: at.x - radius, y: at.y - radius, width: 2 * radius, height: 2 * radius});
}

function freeBox(at, width, height) {
    let second = null;
    for (let reach = 14; reach < 130; reach += 12) {
        for (const angle of [-0.7, 0.7, -2.4, 2.4, -1.5, 1.5, 0, 3.1]) {
            const x = at.x + reach * Math.cos(angle) - (Math.cos(angle) < -0.1 ? width : 0);
            const y = at.y + reach * Math.sin(angle) - height / 2;
            const box = {x, y, width, height};
            const inView = x > 2 && y > 2 && x + width < canvas.clientWidth - 46 &&
                y + height < canvas.clientHeight - 2;
            if (inView && isFree(box)) {
                if (!hidesBody(box, at)) {
                    return box;
                }
                second = second || box;
            }
        }
        if (second && reach > 60) {
            break;
        }
    }
    return second;
}

// Lets little of what is drawn in a box show through the text that comes over it.
function clearBehind(box) {
    pen.globalAlpha = 0.9;
    pen.fillStyle = ink.paper;
    pen.fillRect(box.x, box.y, box.width, box.height);
    pen.globalAlpha = 1;
}

function shorten(text) {
    const room = Math.min(480, 0.6 * canvas.clientWidth);
    const {width} = pen.measureText(text);
    return width > room ? text.slice(0, Math.floor(text.length * room / width) - 1) + '…' : text;
}

function putLabel(text, at, colour, bold) {
    pen.font = mapFont(bold ? 14 : 12.5, bold);
    const shown = shorten(text);
    const box = onScreen(at, 0) ? freeBox(at, pen.measureText(shown).width + 8, 18) : null;
    if (!box) {
        return;
    }
    taken.push(box);
    const x = Math.max(box.x, Math.min(at.x, box.x + box.width));
    const y = Math.max(box.y, Math.min(at.y, box.y + box.height));
    if (Math.hypot(at.x - x, at.y - y) > 12) {
        pen.strokeStyle = colour;
        pen.lineWidth = 0.8;
        line(at, {x, y});
    }
    clearBehind(box);
    pen.fillStyle = colour;
    pen.textBaseline = 'middle';
    pen.fillText(shown, box.x + 4, box.y + 9.5);
}

// The object's id, with its class unless the id contains it.
function objectLabel(row) {
    const id = names[column('object_id')[row]];
    const kind = names[column('object_class')[row]];
    return id.includes(kind) ? id : `${id} (${kind})`;
}

function isWorthLabel(row, box) {
    if (hasTarget(column('object_id')[row]) || column('object_id')[row] === head.scenes[state.scene].ego) {
        return onScreen(toScreen(box), 0);
    }
    const size = Math.max(box.length, box.width) * camera.scale;
    const slim = Math.min(box.length, box.width) * camera.scale < 7;
    return column('object_id')[row] === state.object ||
        (size > 26 && !slim && onScreen(toScreen(box), 0));
}

// The rows of a frame's objects as they are labelled: the chosen one and the ego, then those with
// targets, then others.
function rowsToLabel(ego) {
    const listed = new Set();
    eachTarget(state.frame, (scan, target) => listed.add(objectOfTarget(target)));
    const rank = row => {
        const id = column('object_id')[row];
        return id === state.object ? 0 : id === ego ? 1 : listed.has(id) ? 2 : 3;
    };
    return numbersIn(objectsOf(state.frame)).sort((a, b) => rank(a) - rank(b) || a - b);
}

function hasTarget(id) {
    const isOwn = target => objectOfTarget(target) === id;
    return numbersIn(scansOf(state.frame)).some(scan => numbersIn(targetsOf(scan)).some(isOwn));
}

function drawLabels() {
    if (state.target >= 0) {
        labelContributors(state.target);
    } else {
        labelFates();
        labelAge();
    }
    labelObjects();
}

function labelObjects() {
    const ego = head.scenes[state.scene].ego;
    let room = 24;
    for (const row of rowsToLabel(ego)) {
        const box = boxOf(row);
        if (isWorthLabel(row, box) && room-- > 0) {
            const isEgo = column('object_id')[row] === ego;
            labelObject(box, isEgo ? 'ego' : objectLabel(row), isEgo ? ink.paper : ink.soft);
        }
    }
}

// Labels a box inside if the text fits, else beside it.
function labelObject(box, text, colour) {
    const at = toScreen(box);
    const turn = screenAngle(box.yaw);
    const cos = Math.abs(Math.cos(turn));
    const sin = Math.abs(Math.sin(turn));
    const size = {
        x: (box.length * cos + box.width * sin) * camera.scale,
        y: (box.length * sin + box.width * cos) * camera.scale,
    };
    pen.font = mapFont(12);
    const width = pen.measureText(text).width;
    const place = {x: at.x - width / 2, y: at.y - 8, width, height: 16};
    if (width < 0.7 * Math.max(size.x, size.y) && size.y > 22 && width < size.x && isFree(place)) {
        taken.push(place);
        pen.fillStyle = colour;
        pen.textBaseline = 'middle';
        pen.fillText(text, place.x, at.y);
    } else {
        putLabel(text, at, ink.soft);
    }
}
