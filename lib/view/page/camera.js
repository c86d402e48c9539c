// Zooming, panning and fitting of the map's camera.

function zoomBy(factor, x, y) {
    const before = screenToLocal(x, y);
    camera.scale = Math.max(0.2, Math.min(800, camera.scale * factor));
    const after = screenToLocal(x, y);
    camera.x += before.x - after.x;
    camera.y += before.y - after.y;
    redraw();
}

// Zooms the map, or the side plot if it covers the map.
function zoomMiddle(factor) {
    if (state.large) {
        const {clientWidth: width, clientHeight: height} = plots[state.large].canvas;
        zoomPlot(state.large, factor, width / 2, height / 2);
    } else {
        zoomBy(factor, canvas.clientWidth / 2, canvas.clientHeight / 2);
    }
}

function panBy(dx, dy) {
    const from = screenToLocal(0, 0);
    const to = screenToLocal(dx, dy);
    camera.x -= to.x - from.x;
    camera.y -= to.y - from.y;
    redraw();
}

// Places that must be in view when the page fits the map: the sensors, the chosen object and its
// targets, those that the scene is about; without a chosen object all objects and targets.
function placesToFit() {
    const places = [];
    const scans = scansOf(state.frame);
    for (let scan = scans.begin; scan < scans.end; scan++) {
        places.push(scanPlace(scan, 0, 0));
    }
    const {begin, end} = objectsOf(state.frame);
    for (let row = begin; row < end; row++) {
        if (state.object < 0 || column('object_id')[row] === state.object) {
            places.push(...outlineOf(boxOf(row)));
        }
    }
    eachTarget(state.frame, (scan, target) => {
        if (state.object < 0 || objectOfTarget(target) === state.object || state.focus.includes(target)) {
            places.push(targetPlace(scan, target));
        }
    });
    if (state.cause !== null && state.object < 0) {
        places.push(...placesOfCause());
    }
    return places.concat(state.ego ? outlineOf(state.ego) : []).map(toLocal);
}

// Low and high end of places along an axis, seen from the ego if the view follows it.
function spreadOf(places, axis) {
    const values = places.map(place => place[axis]);
    return {low: Math.min(...values), high: Math.max(...values)};
}

// Fits what lies before and behind the ego into a length of so many pixels, less those that are taken
// above, the ego in the lower third: the scale, and how many pixels the middle is ahead of the ego.
function fitAhead({low, high}, whole, above) {
    const pixels = whole - above;
    const behind = Math.max(2, -low) + 1;
    const ahead = Math.max(5, high) + 1;
    const share = Math.max(0.2, Math.min(0.3, behind / (behind + ahead)));
    const scale = 0.92 * Math.min(share * pixels / behind, (1 - share) * pixels / ahead);
    return {scale, middle: whole / 2 - share * pixels};
}

// The camera that shows places: beside the legend where it is tall, else below it, the ego in the
// lower third.
function cameraFor(places) {
    const x = spreadOf(places, 'x');
    const y = spreadOf(places, 'y');
    const upright = state.up === 'up';
    const [along, whole] = upright ? [canvas.clientHeight, canvas.clientWidth]
        : [canvas.clientWidth, canvas.clientHeight];
    const legend = control('legend');
    const tall = legend.offsetHeight > 50;
    const beside = upright && tall ? Math.min(legend.offsetWidth, 0.36 * whole) : 0;
    const above = upright && !tall ? legend.offsetTop + legend.offsetHeight : 0;
    const across = whole - beside;
    const limit = Math.min(60, across / (1.3 * (y.high - y.low) + 5));
    const ahead = state.follow && state.ego ? fitAhead(x, along, above) : null;
    const wanted = ahead ? ahead.scale : along / (1.25 * (x.high - x.low) + 4);
    const scale = Math.max(0.5, Math.min(limit, wanted));
    return {scale, x: ahead ? ahead.middle / scale : (x.low + x.high) / 2,
        y: (y.low + y.high) / 2 + beside / 2 / scale};
}

// The local places of a frame's targets, from near to far, without false alarms: where those are is
// chance.
function targetsToOpen() {
    const {x, y} = state.ego ? toLocal(state.ego) : {x: 0, y: 0};
    const places = [];
    eachTarget(state.frame, (scan, target) => {
        if (kindOf(target) !== 'false_alarm') {
            places.push(toLocal(targetPlace(scan, target)));
        }
    });
    const far = place => Math.hypot(place.x - x, place.y - y);
    return places.sort((a, b) => far(a) - far(b));
}

const leastScale = 10 / 4.5; // of the first view, px/m: a car is 10 px long

// Shows what must be in view and all targets. Where they lie so far apart that a car would be shorter
// than 10 px, the farthest are left out.
function openView() {
    if (state.frame < 0) {
        return;
    }
    const needed = placesToFit();
    const targets = targetsToOpen();
    const least = Math.min(leastScale, cameraFor(needed).scale);
    while (targets.length > 0 && cameraFor(needed.concat(targets)).scale < least) {
        targets.pop();
    }
    Object.assign(camera, cameraFor(needed.concat(targets)));
    redraw();
}

function fitView() {
    if (state.large) {
        showWholePlot(state.large);
    } else if (state.frame >= 0) {
        Object.assign(camera, cameraFor(placesToFit()));
        redraw();
    }
}

// Shows every target of the frame.
function fitTargets() {
    const places = [];
    eachTarget(state.frame, (scan, target) => places.push(toLocal(targetPlace(scan, target))));
    Object.assign(camera, cameraFor(placesToFit().concat(places)));
    redraw();
}

// Follows the ego or not; the middle of the view stays where it is, although local coordinates
// change.
function setFollow(follow) {
    const middle = fromLocal(camera);
    state.follow = follow;
    Object.assign(camera, toLocal(middle));
    redraw();
}
