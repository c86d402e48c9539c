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

// Places of the ego and its sensors.
function ownPlaces() {
    const places = state.ego ? outlineOf(state.ego) : [];
    return places.concat(numbersIn(scansOf(state.frame)).map(scan => scanPlace(scan, 0, 0)));
}

// Places that must be in view when the page fits the map: the sensors, the chosen object and its
// targets; without a chosen object all objects and targets.
function placesToFit() {
    const places = ownPlaces();
    const {begin, end} = objectsOf(state.frame);
    for (let row = begin; row < end; row++) {
        if (state.object < 0 || column('object_id')[row] === state.object) {
            places.push(...outlineOf(boxOf(row)));
        }
    }
    eachTarget(state.frame, (scan, target) => {
        if (state.object < 0 || objectOfTarget(target) === state.object) {
            places.push(targetPlace(scan, target));
        }
    });
    if (state.cause !== null && state.object < 0) {
        places.push(...placesOfCause());
    }
    return places.map(toLocal);
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

// The local places of a frame's targets, or else of its road users; from near to far.
function placesToOpen() {
    const {x, y} = state.ego ? toLocal(state.ego) : {x: 0, y: 0};
    const places = [];
    eachTarget(state.frame, (scan, target) => places.push(toLocal(targetPlace(scan, target))));
    const {begin, end} = places.length === 0 ? objectsOf(state.frame) : {begin: 0, end: 0};
    for (let row = begin; row < end; row++) {
        if (isRoadUser(row)) {
            places.push(toLocal(boxOf(row)));
        }
    }
    const far = place => Math.hypot(place.x - x, place.y - y);
    return places.sort((a, b) => far(a) - far(b));
}

const openedHeight = 120; // m, most that the first view shows from bottom to top for other targets

// Shows the chosen object with its targets, and what else is near enough to see: of the other targets, as
// many of the nearest as fit.
function openView() {
    if (state.frame < 0) {
        return;
    }
    const needed = state.object < 0 ? ownPlaces().map(toLocal) : placesToFit();
    const others = placesToOpen();
    const least = Math.min(canvas.clientHeight / openedHeight, cameraFor(needed).scale);
    while (others.length > 0 && cameraFor(needed.concat(others)).scale < least) {
        others.pop();
    }
    Object.assign(camera, cameraFor(needed.concat(others)));
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
