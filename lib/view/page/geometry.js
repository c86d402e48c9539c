// Places in the scene's coordinates: metres, x and y as in the stream, relative to the ego's start.

const classIndex = new Map(head.classes.map(kind => [kind.name, indexOfClass(kind)]));

function indexOfClass(kind) {
    const {points = [], planes = [], rows = []} = kind.reflectors;
    const reflectors = new Map();
    points.forEach(point => reflectors.set(point.name, {...point, kind: 'point'}));
    planes.forEach(plane => reflectors.set(plane.name, {...plane, kind: 'plane'}));
    return {known: kind.known, points, planes, rows, reflectors};
}

function classOf(row) {
    return classIndex.get(names[column('object_class')[row]]);
}

function boxOf(row) {
    const yaw = column('object_yaw_rad')[row];
    return {
        x: column('object_x_m')[row],
        y: column('object_y_m')[row],
        yaw,
        cos: Math.cos(yaw),
        sin: Math.sin(yaw),
        length: column('object_length_m')[row],
        width: column('object_width_m')[row],
    };
}

// A place in the scene, from fractions of the box.
function placeIn(box, x, y) {
    const ahead = x * box.length;
    const left = y * box.width;
    return {
        x: box.x + ahead * box.cos - left * box.sin,
        y: box.y + ahead * box.sin + left * box.cos,
    };
}

function outlineOf(box) {
    return [[0.5, 0.5], [-0.5, 0.5], [-0.5, -0.5], [0.5, -0.5]].map(([x, y]) => placeIn(box, x, y));
}

function pointPlace(box, point) {
    const place = placeIn(box, point.x, point.y);
    const angle = box.yaw + point.facing_rad;
    const inset = point.inset_m || 0;
    place.x -= inset * Math.cos(angle);
    place.y -= inset * Math.sin(angle);
    return place;
}

function segmentOf(box, line) {
    return [placeIn(box, line.from_x, line.from_y), placeIn(box, line.to_x, line.to_y)];
}

function between(from, to, part) {
    return {x: from.x + part * (to.x - from.x), y: from.y + part * (to.y - from.y)};
}

function postPlace(box, row, post) {
    const [from, to] = segmentOf(box, row);
    const length = Math.hypot(to.x - from.x, to.y - from.y);
    return length === 0 ? from : between(from, to, post * row.spacing_m / length);
}

function postCount(box, row) {
    const [from, to] = segmentOf(box, row);
    return 1 + Math.floor(Math.hypot(to.x - from.x, to.y - from.y) / row.spacing_m + 1e-9);
}

// The place of an object's reflector, and for a flat side its segment. Null if the class has no
// document or the document no such reflector.
function reflectorPlace(row, name) {
    const kind = classOf(row);
    const box = boxOf(row);
    const known = kind.reflectors.get(name);
    if (known !== undefined && known.kind === 'point') {
        return {place: pointPlace(box, known)};
    }
    if (known !== undefined) {
        const segment = segmentOf(box, known);
        return {place: between(segment[0], segment[1], 0.5), segment};
    }
    const post = /^(.*)_(\d+)$/.exec(name);
    const found = post && kind.rows.find(one => one.name === post[1]);
    return found ? {place: postPlace(box, found, Number(post[2]))} : null;
}

function scanPlace(scan, range, azimuth) {
    const angle = column('scan_yaw_rad')[scan] + azimuth;
    return {
        x: column('scan_x_m')[scan] + range * Math.cos(angle),
        y: column('scan_y_m')[scan] + range * Math.sin(angle),
    };
}

function targetPlace(scan, target) {
    return scanPlace(scan, column('target_range_m')[target], column('target_azimuth_rad')[target]);
}

function contributorPlace(scan, row) {
    return scanPlace(scan, column('contributor_range_m')[row], column('contributor_azimuth_rad')[row]);
}

function inside(box, place) {
    const dx = place.x - box.x;
    const dy = place.y - box.y;
    return Math.abs(dx * box.cos + dy * box.sin) <= box.length / 2 &&
        Math.abs(dy * box.cos - dx * box.sin) <= box.width / 2;
}
