// Mouse and touch, on the map and on the side plots: one pointer pans or clicks, two zoom.

function pointerPlace(event) {
    const frame = event.currentTarget.getBoundingClientRect();
    return {x: event.clientX - frame.left, y: event.clientY - frame.top};
}

// Calls pan(dx, dy), zoom(factor, x, y) and click(place) for pointers and the wheel on a canvas, in pixels
// of the canvas.
function connectPointers(element, {pan, zoom, click}) {
    const pointers = new Map();
    let moved = 0;
    const release = event => {
        const clicked = pointers.size === 1 && pointers.has(event.pointerId) && moved <= 4;
        pointers.delete(event.pointerId);
        if (clicked && event.type === 'pointerup') {
            click(pointerPlace(event));
        }
    };
    element.addEventListener('pointerdown', event => {
        moved = pointers.size === 0 ? 0 : Infinity;
        pointers.set(event.pointerId, pointerPlace(event));
        element.setPointerCapture(event.pointerId);
    });
    element.addEventListener('pointermove', event => {
        const from = pointers.get(event.pointerId);
        if (!from) {
            return;
        }
        const to = pointerPlace(event);
        const other = [...pointers].find(([id]) => id !== event.pointerId);
        moved += Math.hypot(to.x - from.x, to.y - from.y);
        pointers.set(event.pointerId, to);
        if (other) {
            pinch(from, to, other[1], {pan, zoom});
        } else if (moved > 4) {
            pan(to.x - from.x, to.y - from.y);
        }
    });
    element.addEventListener('pointerup', release);
    element.addEventListener('pointercancel', release);
    element.addEventListener('wheel', event => {
        event.preventDefault();
        const at = pointerPlace(event);
        zoom(Math.exp(-event.deltaY * (event.deltaMode === 1 ? 0.05 : 0.0015)), at.x, at.y);
    }, {passive: false});
}

function pinch(from, to, other, {pan, zoom}) {
    const before = Math.hypot(from.x - other.x, from.y - other.y);
    const after = Math.hypot(to.x - other.x, to.y - other.y);
    pan((to.x - from.x) / 2, (to.y - from.y) / 2);
    zoom(after / Math.max(1, before), (to.x + other.x) / 2, (to.y + other.y) / 2);
}

function nearest(candidates, at, reach) {
    let best = null;
    let least = reach;
    for (const candidate of candidates) {
        const distance = Math.hypot(candidate.x - at.x, candidate.y - at.y);
        if (distance < least) {
            least = distance;
            best = candidate;
        }
    }
    return best;
}

function targetHits() {
    const hits = [];
    eachTarget(state.frame, (scan, target) =>
        hits.push({...toScreen(targetPlace(scan, target)), target}));
    return hits;
}

function reflectorHits() {
    const hits = [];
    const {begin, end} = objectsOf(state.frame);
    for (let row = begin; row < end; row++) {
        const object = column('object_id')[row];
        if (object === head.scenes[state.scene].ego || camera.scale < 6) {
            continue;
        }
        const box = boxOf(row);
        for (const [reflector, spot] of spotsOf(object)) {
            hits.push({...toScreen(spotPlace(box, spot)), object, name: names[reflector]});
        }
    }
    return hits.concat(contributorHits(), lossHits());
}

// Contributors of targets can be clicked where they were seen: a flat side reflects from its
// specular point, not from its middle.
function contributorHits() {
    const hits = [];
    eachTarget(state.frame, (scan, target) => {
        const {begin, end} = contributorsOf(target);
        for (let i = begin; i < end; i++) {
            hits.push({
                ...toScreen(contributorPlace(scan, i)),
                object: column('contributor_object')[i],
                name: names[column('contributor_reflector')[i]],
                echo: echoOfContributor(i),
            });
        }
    });
    return hits;
}

// Lost echoes can be clicked where they are drawn: those of the chosen object, or, with nothing
// chosen, those of the cause that is shown.
function lossHits() {
    const losses = state.object < 0 ? lossesFor(state.cause) : [];
    eachScan(scan => losses.push(...lossesOf(scan, state.object)
        .filter(loss => loss.reason.notable).map(loss => ({scan, loss}))));
    return losses.map(({scan, loss}) => ({place: lossPlace(scan, loss), loss}))
        .filter(({place}) => place !== null)
        .map(({place, loss}) => ({...toScreen(place), object: loss.object, name: names[loss.reflector],
            echo: loss}));
}

// The smallest object under a place on the screen, or -1.
function objectAt(at) {
    const {begin, end} = objectsOf(state.frame);
    const local = screenToLocal(at.x, at.y);
    let best = {area: Infinity, object: -1};
    for (let row = begin; row < end; row++) {
        const box = boxOf(row);
        const area = box.length * box.width;
        if (area < best.area && inside(box, fromLocal(local))) {
            best = {area, object: column('object_id')[row]};
        }
    }
    return best.object;
}

function clickAt(at) {
    if (state.frame < 0) {
        return;
    }
    const target = targetMeant(targetHits(), at);
    const reflector = nearest(reflectorHits(), at, target ? 6 : 11);
    const onTarget = target && (!reflector || Math.hypot(target.x - at.x, target.y - at.y) <=
        Math.hypot(reflector.x - at.x, reflector.y - at.y) + 3);
    if (onTarget) {
        chooseTarget(target.target);
    } else if (reflector) {
        chooseReflector(reflector.name, reflector.object, reflector.echo);
    } else {
        chooseObject(objectAt(at));
    }
}

function clickPlot(plot, at) {
    const hit = targetMeant(plot.hits, at);
    if (hit) {
        chooseTarget(hit.target);
    }
}
