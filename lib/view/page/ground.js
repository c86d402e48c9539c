// What lies or stands on the ground along the road, as lines and bands.

// Draws the strips on which rails, poles, kerbs and vegetation stand: bands as wide as they are, or
// lines, which are dotted for poles.
function drawRoadside() {
    for (const strip of head.scenes[state.scene].roadside || []) {
        context.strokeStyle = strip.width_m > 0 ? ink.grid : ink.edge;
        context.lineWidth = Math.max(1.5, (strip.width_m || 0) * camera.scale);
        context.setLineDash(strip.kind === 'poles' ? [2, 6] : []);
        line(toScreen({x: strip.from_x_m, y: strip.from_y_m}), toScreen({x: strip.to_x_m, y: strip.to_y_m}));
    }
    context.setLineDash([]);
}
