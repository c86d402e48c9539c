// What lies under the pointer: the target that it means, in words, and the next one of a stack.

const tip = document.getElementById('tip');

// The targets near a place on a canvas, nearest first.
function hitsNear(hits, at, reach) {
    const apart = hit => Math.hypot(hit.x - at.x, hit.y - at.y);
    return hits.filter(hit => apart(hit) < reach).sort((a, b) => apart(a) - apart(b) || a.target - b.target);
}

// The targets whose symbols lie over each other where the nearest one is, in the order of lists.
function stackAt(hits, at) {
    const near = hitsNear(hits, at, 14);
    return near.length === 0 ? []
        : hitsNear(hits, near[0], 6).sort((a, b) => a.target - b.target);
}

// The target that a click means: the nearest, or in a stack the one after the chosen target.
function targetMeant(hits, at) {
    const stack = stackAt(hits, at);
    const chosen = stack.findIndex(hit => hit.target === state.target);
    return chosen >= 0 ? stack[(chosen + 1) % stack.length] : hitsNear(hits, at, 14)[0];
}

function targetWords(scan, target) {
    const value = name => column('target_' + name)[target];
    const number = target - targetsOf(scan).begin + 1;
    const up = elevationOf(target, 'elevation_reported_rad', 1);
    return `${sensorOf(scan).name} ${number}: ${round(value('range_m'), 2)} m, ` +
        `${round(value('azimuth_rad') * degrees, 1)}° off boresight, ${up && up + ' up, '}${round(value('range_rate_mps'), 2)} m/s, ` +
        `${round(value('amplitude_db'), 1)} dB, ${names[objectOfTarget(target)]}`;
}

function setHover(target) {
    if (state.hover !== target) {
        state.hover = target;
        markHoveredRow();
        redraw();
    }
}

function hideTip() {
    tip.hidden = true;
    setHover(-1);
}

// Shows a line of words beside a place in the window.
function showTip(text, x, y) {
    tip.textContent = text;
    tip.hidden = false;
    tip.style.left = Math.max(4, Math.min(x + 14, window.innerWidth - tip.offsetWidth - 4)) + 'px';
    tip.style.top = Math.max(4, y - tip.offsetHeight - 12) + 'px';
}

function hoverOver(hits, at, event) {
    const near = hitsNear(hits, at, 14);
    const stack = stackAt(hits, at);
    if (near.length === 0 || event.buttons !== 0 || event.pointerType === 'touch') {
        hideTip();
        return;
    }
    const {target} = near[0];
    const more = stack.length > 1 ? ` (${stack.length} here: click again for the next)` : '';
    showTip(targetWords(scanOfTarget(state.frame, target), target) + more, event.clientX, event.clientY);
    setHover(target);
}

function drawHover() {
    if (state.hover >= 0 && state.hover !== state.target) {
        const at = toScreen(targetPlace(scanOfTarget(state.frame, state.hover), state.hover));
        pen.beginPath();
        pen.arc(at.x, at.y, 13, 0, 2 * Math.PI);
        pen.strokeStyle = ink.soft;
        pen.lineWidth = 2;
        pen.stroke();
    }
}

function connectHover() {
    canvas.addEventListener('pointermove', event => state.frame >= 0 && hoverOver(targetHits(), pointerPlace(event), event));
    canvas.addEventListener('pointerleave', hideTip);
    for (const plot of Object.values(plots)) {
        plot.canvas.addEventListener('pointermove', event =>
            hoverOver(plot.hits, {x: event.offsetX, y: event.offsetY}, event));
        plot.canvas.addEventListener('pointerleave', hideTip);
    }
}
