// Places in the scene's coordinates: metres, x and y as in the stream, relative to the ego's start.

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
        vx: column('object_vx_mps')[row],
        vy: column('object_vy_mps')[row],
        yawRate: column('object_yaw_rate_radps')[row],
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

// A box as it was some time before: at constant speed and turn rate.
function boxBefore(box, age) {
    if (age === 0) {
        return box;
    }
    const yaw = box.yaw - box.yawRate * age;
    const half = -box.yawRate * age / 2;
    const chord = -age * (Math.abs(half) < 1e-9 ? 1 : Math.sin(half) / half);
    return {
        ...box,
        x: box.x + chord * (box.vx * Math.cos(half) - box.vy * Math.sin(half)),
        y: box.y + chord * (box.vx * Math.sin(half) + box.vy * Math.cos(half)),
        yaw,
        cos: Math.cos(yaw),
        sin: Math.sin(yaw),
    };
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
