// The bird's-eye view. "Local" coordinates are the ego's (x ahead, y left) while the view follows
// it, else the scene's; the camera's x and y are a local place, its scale is pixels per metre.

const canvas = document.getElementById('map');
// A canvas has no parts, as the pen of a picture has (svg_pen.js).
const canvasPen = Object.assign(canvas.getContext('2d'), {beginPart() {}, endPart() {}});
let pen = canvasPen; // with which the map is drawn

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
    pen.beginPath();
    pen.moveTo(from.x, from.y);
    pen.lineTo(to.x, to.y);
    pen.stroke();
}

function onScreen(at, margin) {
    return at.x > -margin && at.y > -margin && at.x < mapSize.width + margin &&
        at.y < mapSize.height + margin;
}

function drawDot(at, radius, colour) {
    pen.beginPath();
    pen.arc(at.x, at.y, radius, 0, 2 * Math.PI);
    pen.fillStyle = colour;
    pen.fill();
}

function reserveRoom() {
    taken = [];
    for (const {offsetLeft, offsetTop, offsetWidth, offsetHeight} of [control('legend'), control('outside')]) {
        taken.push({x: offsetLeft, y: offsetTop, width: offsetWidth, height: offsetHeight});
    }
    noteBodies();
    eachTarget(state.frame, (scan, target) => takeAround(toScreen(targetPlace(scan, target)), 7));
}

// What the map shows, from the ground up: each layer draws, and may tell the legend what its marks mean.
const layers = [
    {draw: drawGround, legend: groundMeanings},
    {draw: drawGrid},
    {draw: drawRings},
    {draw: drawBeams, legend: beamMeanings},
    {draw: drawObjects},
    {draw: drawReflectors, legend: reflectorMeanings},
    {draw: drawRingNumbers},
    {draw: drawGridNumbers},
    {draw: drawMeasuredBodies, legend: measuredMeanings},
    {draw: drawEchoes, legend: echoMeanings},
    {draw: drawTrail, legend: trailMeanings},
    {draw: drawFates, legend: lossMeanings},
    {draw: drawCause},
    {draw: drawChosenReflector},
    {draw: drawChosenEchoes},
    {draw: drawTargets, legend: targetMeanings},
    {draw: drawLabels},
    {draw: drawComparison, legend: comparisonMeanings},
];

function drawLayers() {
    reserveRoom();
    layers.forEach(layer => layer.draw());
}

function drawMap() {
    mapSize = fitCanvas(canvas, canvasPen);
    if (state.frame >= 0) {
        drawLayers();
        tellOutside();
    }
}

// How many targets lie beyond the edges of the map, in words; nothing if there are none.
function outsideWords() {
    let count = 0;
    eachTarget(state.frame, (scan, target) => {
        count += onScreen(toScreen(targetPlace(scan, target)), 0) ? 0 : 1;
    });
    return count === 0 ? '' : `${plural(count, 'target')} off the map`;
}

// Says so on a button, which brings them into view.
function tellOutside() {
    const text = outsideWords();
    control('outside').hidden = text === '';
    setText(control('outside'), text);
}
