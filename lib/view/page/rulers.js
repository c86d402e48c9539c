// The map's rulers: a grid with numbers in metres, and rings of equal range.

// The distance of grid lines that are at least some pixels apart: a round number of metres.
function gridStep(pixels) {
    const wanted = pixels / camera.scale;
    const power = Math.pow(10, Math.floor(Math.log10(wanted)));
    return [1, 2, 5, 10].map(factor => factor * power).find(step => step >= wanted);
}

// What of the local plane is in view.
function viewedArea() {
    const corner = screenToLocal(0, 0);
    const other = screenToLocal(canvas.clientWidth, canvas.clientHeight);
    return {
        low: {x: Math.min(corner.x, other.x), y: Math.min(corner.y, other.y)},
        high: {x: Math.max(corner.x, other.x), y: Math.max(corner.y, other.y)},
    };
}

function metres(value) {
    return String(Number(value.toPrecision(3))).replace('-', '−');
}

// Writes a number on the map where it is whole and over no other one, and keeps labels away from it.
function rulerText(text, x, y) {
    pen.font = mapFont(11);
    const width = pen.measureText(text).width;
    const box = {x: x - width / 2 - 3, y: y - 7, width: width + 6, height: 14};
    if (!isFree(box) || box.x < 0 || box.y < 0 || box.x + box.width > mapSize.width ||
        box.y + box.height > mapSize.height) {
        return;
    }
    taken.push(box);
    clearBehind(box);
    pen.fillStyle = ink.soft;
    pen.textBaseline = 'middle';
    pen.fillText(text, box.x + 3, y + 0.5);
}

function drawGrid() {
    const step = gridStep(70);
    const {low, high} = viewedArea();
    pen.strokeStyle = ink.grid;
    pen.lineWidth = 1;
    for (let x = Math.ceil(low.x / step) * step; x <= high.x; x += step) {
        line(localToScreen({x, y: low.y}), localToScreen({x, y: high.y}));
    }
    for (let y = Math.ceil(low.y / step) * step; y <= high.y; y += step) {
        line(localToScreen({x: low.x, y}), localToScreen({x: high.x, y}));
    }
}

// Writes how far ahead each line across lies along one edge of the map, how far left each line along
// lies along the other.
function drawGridNumbers() {
    const step = gridStep(70);
    const {low, high} = viewedArea();
    const bottom = canvas.clientHeight - 11;
    const upright = state.up === 'up';
    rulerText(state.follow ? 'axes: m ahead and left of the ego' : 'axes: m from the ego’s start', 118, bottom);
    for (let x = Math.ceil(low.x / step) * step; x <= high.x; x += step) {
        const at = localToScreen({x, y: 0});
        rulerText(metres(x), ...(upright ? [20, at.y] : [at.x, bottom]));
    }
    for (let y = Math.ceil(low.y / step) * step; y <= high.y; y += step) {
        const at = localToScreen({x: 0, y});
        rulerText(metres(y), ...(upright ? [at.x, bottom] : [20, at.y]));
    }
}

// The place from which ranges count: the sensor if there is one, else the middle of the ego.
function ringCentre() {
    const {begin, end} = scansOf(state.frame);
    return end - begin === 1 ? scanPlace(begin, 0, 0) : state.ego;
}

// The rings on the screen: their middle, and their radii in metres.
function ringsInView() {
    const centre = ringCentre();
    const {begin, end} = scansOf(state.frame);
    if (end === begin || !centre) {
        return {at: null, ranges: []};
    }
    let farthest = 0;
    for (let scan = begin; scan < end; scan++) {
        farthest = Math.max(farthest, sensorOf(scan).range_max_m);
    }
    const step = Math.min(gridStep(110), roundStep(farthest, 4)); // at least two rings
    const ranges = [];
    for (let range = step; range <= farthest && range < 40 * step; range += step) {
        ranges.push(range);
    }
    return {at: toScreen(centre), ranges};
}

function drawRings() {
    const {at, ranges} = ringsInView();
    pen.strokeStyle = ink.faint;
    pen.lineWidth = 1;
    for (const range of ranges) {
        pen.beginPath();
        pen.arc(at.x, at.y, range * camera.scale, 0, 2 * Math.PI);
        pen.stroke();
    }
}

function drawRingNumbers() {
    const {at, ranges} = ringsInView();
    const angle = screenAngle(state.ego ? state.ego.yaw : 0) + 0.3;
    for (const range of ranges) {
        rulerText(`${metres(range)} m`, at.x + range * camera.scale * Math.cos(angle),
            at.y + range * camera.scale * Math.sin(angle));
    }
}
