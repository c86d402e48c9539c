// The legend of the marks on the map, as the map's layers tell them, with switches of what is shown.

// What a mark means. paint draws it into 18 by 16 pixels; sensor is the style of the one that a click on it
// switches off and on, if any.
function meaning(paint, text, sensor) {
    return {paint, text, sensor};
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

function symbolMark(style, colour, kind) {
    return drawing => drawTargetSymbol(drawing, style, 9, 8, 6, colour, kind);
}

function lineMark(width, lines, colour = ink.soft) {
    return drawing => {
        drawing.strokeStyle = colour;
        drawing.lineWidth = width;
        drawing.beginPath();
        for (const [x, y, toX, toY] of lines) {
            drawing.moveTo(x, y);
            drawing.lineTo(toX, toY);
        }
        drawing.stroke();
    };
}

function dotMark(colour) {
    return drawing => {
        drawing.fillStyle = colour;
        drawing.beginPath();
        drawing.arc(9, 8, 2.5, 0, 2 * Math.PI);
        drawing.fill();
    };
}

// Bars of these colours side by side.
function barsMark(colours, gap) {
    const width = 18 / colours.length;
    return drawing => colours.forEach((colour, i) => {
        drawing.fillStyle = colour;
        drawing.fillRect(width * i, 3, width - gap, 10);
    });
}

const pathsSeen = [...new Set(column('contributor_path'))].sort((a, b) => a - b);
const bodyPaths = pathsSeen.filter(path => head.kinds[path] === 'body').length;

// What of the legend is in view on a small screen until it is unfolded: the marks of the sensors.
function legendTitle() {
    const title = make('summary', 'legend');
    sensorNames.forEach((name, i) => title.append(symbolCanvas(i, sensorColour(i), 16), make('bdi', name)));
    return title;
}

const smallScreen = window.matchMedia('screen and (max-width: 800px), screen and (max-height: 520px)');

function foldLegend() {
    control('legend').open = !smallScreen.matches;
}

// From the uppermost layer of the map to the ground.
function legendMeanings() {
    return layers.filter(layer => layer.legend).reverse().flatMap(layer => layer.legend());
}

function legendLine({paint, text, sensor}) {
    const mark = markCanvas(paint);
    if (sensor !== undefined) {
        return switchLine('sensor', sensor, mark, text);
    }
    const line = make('div');
    line.append(mark, make('span', text));
    return line;
}

function showLegend() {
    control('legend').replaceChildren(legendTitle(), ...legendMeanings().map(legendLine), switchesBelow());
}
