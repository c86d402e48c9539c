// The legend: the meaning of symbols, lines and colours.

function legendLine(mark, text) {
    const line = make('div');
    if (mark) {
        line.append(mark);
    }
    line.append(make('span', text));
    return line;
}

function markCanvas(paint) {
    const small = make('canvas');
    const ratio = window.devicePixelRatio || 1;
    small.width = 18 * ratio;
    small.height = 16 * ratio;
    small.style.width = '18px';
    small.style.height = '16px';
    const drawing = small.getContext('2d');
    drawing.scale(ratio, ratio);
    paint(drawing);
    return small;
}

function lineMark(width, lines) {
    return markCanvas(drawing => {
        drawing.strokeStyle = ink.soft;
        drawing.lineWidth = width;
        drawing.beginPath();
        for (const [x, y, toX, toY] of lines) {
            drawing.moveTo(x, y);
            drawing.lineTo(toX, toY);
        }
        drawing.stroke();
    });
}

function dotMark(colour) {
    return markCanvas(drawing => {
        drawing.fillStyle = colour;
        drawing.beginPath();
        drawing.arc(9, 8, 2.5, 0, 7);
        drawing.fill();
    });
}

const pathsSeen = [...new Set(column('contributor_path'))].sort((a, b) => a - b);
const bodyPaths = pathsSeen.filter(path => head.kinds[path] === 'body').length;

function colourLines() {
    if (state.effect >= 0) {
        const effect = words(head.effects[state.effect]);
        return [legendLine(dotMark(ink.palette[1]), `changed by ${effect}`),
            legendLine(dotMark(ink.edge), 'not changed by it')];
    }
    const gradient = (colours) => markCanvas(drawing => {
        colours.forEach((colour, i) => {
            drawing.fillStyle = colour;
            drawing.fillRect(18 * i / colours.length, 3, 18 / colours.length + 1, 10);
        });
    });
    if (state.colour === 'rate') {
        const top = state.rateScale;
        return [legendLine(gradient([-4, -3, -2, -1, 0, 1, 2, 3, 4].map(part => rateColour(top * part / 4))),
            `approaching ${round(top, 1)} … receding ${round(top, 1)} m/s`)];
    }
    if (state.colour === 'amplitude') {
        const {low, high} = state.amplitudes;
        const levels = [0, 0.25, 0.5, 0.75, 1].map(part => amplitudeColour(low + part * (high - low)));
        return [legendLine(gradient(levels), `amplitude ${round(low, 1)} … ${round(high, 1)} dB`)];
    }
    if (state.colour === 'object') {
        return [legendLine(markCanvas(drawing => {
            ink.palette.slice(0, 3).forEach((colour, i) => {
                drawing.fillStyle = colour;
                drawing.fillRect(6 * i, 4, 5, 8);
            });
        }), 'in the colour of its object')];
    }
    if (state.colour === 'path') {
        return pathsSeen.map(path => legendLine(dotMark(ink.palette[path % ink.palette.length]),
            `path: ${words(head.paths[path])}`));
    }
    return [];
}

// What of the legend is in view on a small screen until it is unfolded: the marks of the sensors.
function legendTitle() {
    const title = make('summary', 'legend');
    sensorNames.forEach((name, i) => title.append(symbolCanvas(i, sensorColour(i), 16), make('bdi', name)));
    return title;
}

const smallScreen = window.matchMedia('(max-width: 800px), (max-height: 520px)');

function foldLegend() {
    control('legend').open = !smallScreen.matches;
}

function showLegend() {
    const lines = sensorNames.map((name, i) => switchLine('sensor', i,
        symbolCanvas(i, sensorColour(i), 18), `target of ${name}`));
    control('legend').replaceChildren(legendTitle(), ...lines, ...kindLines(), ...colourLines(),
        legendLine(lineMark(1.6, [[1, 8, 17, 8]]),
            state.rates === 'raw' ? 'its radial speed, 0.5 s long' : 'its radial speed over ground, 0.5 s long'),
        ...foldedLines(), ...latencyLines(),
        legendLine(lineMark(1.2, [[1, 8, 5, 8], [7, 8, 11, 8], [13, 8, 17, 8]]), 'field of view'),
        legendLine(dotMark(ink.edge), 'reflection centre'),
        ...lossLines(),
        ...comparisonLines(), switchesBelow());
}

const kindWords = {
    ghost: 'ghost: seen by way of a mirror',
    clutter: 'clutter: an echo of the ground or roadside',
    false_alarm: 'false alarm: nothing but noise',
};

// Lines for the kinds of targets besides bodies that the stream has, and for interference.
function kindLines() {
    const kinds = new Set(pathsSeen.map(path => head.kinds[path]));
    const lines = Object.keys(kindWords).filter(kind => kinds.has(kind))
        .map(kind => legendLine(symbolCanvas(0, ink.soft, 18, kind), kindWords[kind]));
    if (effectSets.some(set => set.includes(interferenceEffect))) {
        lines.push(legendLine(markCanvas(drawing => drawBolt(drawing, 2, 13, 6)), 'disturbed by other radars'));
    }
    return lines;
}

function foldedLines() {
    return effectSets.some(set => set.includes(ambiguityEffect))
        ? [legendLine(markCanvas(drawing => drawFoldedRate(drawing, {x: 1, y: 8}, {x: 17, y: 8}, ink.soft)),
            'folded rate: the true one is another')] : [];
}

function latencyLines() {
    const mark = markCanvas(drawing => {
        drawing.strokeStyle = ink.edge;
        drawing.setLineDash([3, 3]);
        drawing.strokeRect(2, 4, 14, 8);
    });
    return extremes('scan_age_s', false).high > 1e-6
        ? [legendLine(mark, 'where the body was when measured')] : [];
}

function lossLines() {
    return column('frame_account').includes(1)
        ? [legendLine(markCanvas(drawing => drawLostMark(drawing, {x: 9, y: 8}, 5)), 'echo that is in no target')]
        : [];
}
