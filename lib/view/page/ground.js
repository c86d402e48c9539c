// What lies or stands on the ground, as lines and bands: a band is as wide as it is, a line has no width of
// its own.

// The colour, dashes and least width in pixels of a kind, as far as it is no plain grey line.
const groundStyles = () => ({
    poles: {dash: [2, 6]},
});

function groundStyle({kind, width_m: width}) {
    return {colour: width > 0 ? ink.grid : ink.edge, dash: [], least: 1.5, ...groundStyles()[kind]};
}

function drawGround() {
    for (const one of head.scenes[state.scene].ground || []) {
        const {colour, dash, least} = groundStyle(one);
        pen.strokeStyle = colour;
        pen.lineWidth = Math.max(least, (one.width_m || 0) * camera.scale);
        pen.setLineDash(dash);
        line(toScreen({x: one.from_x_m, y: one.from_y_m}), toScreen({x: one.to_x_m, y: one.to_y_m}));
    }
    pen.setLineDash([]);
}

// What there is in any scene, each kind once.
function groundMeanings() {
    const kinds = new Map(head.scenes.flatMap(scene => scene.ground || []).map(one => [one.kind, one]));
    return [...kinds.values()].map(one => {
        const {colour, dash, least} = groundStyle(one);
        return meaning(drawing => {
            drawing.strokeStyle = colour;
            drawing.setLineDash(dash);
            drawing.lineWidth = one.width_m > 0 ? 9 : least;
            drawing.beginPath();
            drawing.moveTo(1, 8);
            drawing.lineTo(17, 8);
            drawing.stroke();
        }, words(one.kind));
    });
}
