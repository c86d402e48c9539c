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
// targets; without a chosen object all objects and targets.
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
        if (state.object < 0 || objectOfTarget(target) === state.object) {
            places.push(targetPlace(scan, target));
        }
    });
    return places.map(toLocal);
}

function fitView() {
    if (state.frame < 0) {
        return;
    }
    const places = placesToFit();
    const spread = axis => {
        const values = places.map(place => place[axis]);
        return {low: Math.min(...values), high: Math.max(...values)};
    };
    const x = spread('x');
    const y = spread('y');
    camera.x = (x.low + x.high) / 2;
    camera.y = (y.low + y.high) / 2;
    const across = state.up === 'right' ? x.high - x.low : y.high - y.low;
    const down = state.up === 'right' ? y.high - y.low : x.high - x.low;
    camera.scale = Math.max(0.5, Math.min(90, canvas.clientWidth / (1.25 * across + 4),
        canvas.clientHeight / (1.4 * down + 5)));
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
