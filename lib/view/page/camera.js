// Zooming, panning and fitting of the map's camera.

function zoomBy(factor, x, y) {
    const before = screenToLocal(x, y);
    camera.scale = Math.max(0.2, Math.min(800, camera.scale * factor));
    const after = screenToLocal(x, y);
    camera.x += before.x - after.x;
    camera.y += before.y - after.y;
    redraw();
}

function zoomMiddle(factor) {
    zoomBy(factor, canvas.clientWidth / 2, canvas.clientHeight / 2);
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

// Fits what lies before and behind the ego into a length of so many pixels, the ego in its lower third:
// the scale, and the place in the middle.
function fitAhead({low, high}, pixels) {
    const behind = Math.max(2, -low) + 1;
    const ahead = Math.max(5, high) + 1;
    const share = Math.max(0.2, Math.min(0.3, behind / (behind + ahead)));
    const scale = 0.92 * Math.min(share * pixels / behind, (1 - share) * pixels / ahead);
    return {scale, middle: (0.5 - share) * pixels};
}

function fitView() {
    if (state.frame < 0) {
        return;
    }
    const places = placesToFit();
    const x = spreadOf(places, 'x');
    const y = spreadOf(places, 'y');
    const upright = state.up === 'up';
    const [along, whole] = upright ? [canvas.clientHeight, canvas.clientWidth]
        : [canvas.clientWidth, canvas.clientHeight];
    const beside = upright ? Math.min(control('legend').offsetWidth, 0.36 * whole) : 0;
    const across = whole - beside;
    const limit = Math.min(60, across / (1.3 * (y.high - y.low) + 5));
    if (state.follow && state.ego) {
        const {scale, middle} = fitAhead(x, along);
        camera.scale = Math.max(0.5, Math.min(limit, scale));
        camera.x = middle / camera.scale;
    } else {
        camera.scale = Math.max(0.5, Math.min(limit, along / (1.25 * (x.high - x.low) + 4)));
        camera.x = (x.low + x.high) / 2;
    }
    camera.y = (y.low + y.high) / 2 + beside / 2 / camera.scale;
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
