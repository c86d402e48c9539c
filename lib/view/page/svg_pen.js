// A pen that writes SVG. It has the names of a canvas as far as the map needs them, and joins what belongs
// together to parts with titles, which a canvas does not have.

const unwritable = /[^\t\n\r -\uD7FF\uE000-\uFFFD\u{10000}-\u{10FFFF}]/gu; // in XML

function escaped(text) {
    return text.replace(unwritable, '\uFFFD').replace(/[&<>"]/g, sign => `&#${sign.charCodeAt(0)};`);
}

function pixels(value) {
    return String(Number(value.toFixed(2)));
}

class SvgPen {
    constructor() {
        this.text = '';
        this.path = '';
        this.dash = [];
        this.globalAlpha = 1;
        this.lineJoin = 'miter';
    }

    beginPart(kind, title) {
        this.text += `<g class="${kind}"><title>${escaped(title())}</title>\n`;
    }

    endPart() {
        this.text += '</g>\n';
    }

    setLineDash(dash) {
        this.dash = dash;
    }

    beginPath() {
        this.path = '';
    }

    moveTo(x, y) {
        this.path += `M${pixels(x)} ${pixels(y)}`;
    }

    lineTo(x, y) {
        this.path += `${this.path === '' ? 'M' : 'L'}${pixels(x)} ${pixels(y)}`;
    }

    closePath() {
        this.path += 'Z';
    }

    // Clockwise, in arcs of at most half a turn: an arc that ends where it begins would be none.
    arc(x, y, radius, from, to) {
        const turn = Math.min(2 * Math.PI, to - from);
        const steps = Math.ceil(turn / Math.PI);
        this.lineTo(x + radius * Math.cos(from), y + radius * Math.sin(from));
        for (let i = 1; i <= steps; i++) {
            const angle = from + turn * i / steps;
            this.path += `A${pixels(radius)} ${pixels(radius)} 0 0 1 ` +
                `${pixels(x + radius * Math.cos(angle))} ${pixels(y + radius * Math.sin(angle))}`;
        }
    }

    fill() {
        this.element('path', {d: this.path, ...this.filled()});
    }

    stroke() {
        this.element('path', {d: this.path, ...this.stroked()});
    }

    fillRect(x, y, width, height) {
        this.element('rect', {...rectangle(x, y, width, height), ...this.filled()});
    }

    strokeRect(x, y, width, height) {
        this.element('rect', {...rectangle(x, y, width, height), ...this.stroked()});
    }

    // The text is as wide as on the map, whatever font the viewer has; y is that of its middle.
    fillText(text, x, y) {
        const [, bold, size] = /^(700 )?([\d.]+)px/.exec(this.font);
        this.element('text', {x: pixels(x), y: pixels(y + 0.35 * size), 'font-size': size,
            ...bold ? {'font-weight': 700} : {}, textLength: pixels(this.measureText(text).width),
            lengthAdjust: 'spacingAndGlyphs', ...this.filled()}, escaped(text));
    }

    measureText(text) {
        canvasPen.font = this.font;
        return canvasPen.measureText(text);
    }

    filled() {
        return {fill: this.fillStyle, ...this.globalAlpha < 1 ? {'fill-opacity': this.globalAlpha.toFixed(3)} : {}};
    }

    stroked() {
        return {fill: 'none', stroke: this.strokeStyle, 'stroke-width': pixels(this.lineWidth),
            ...this.dash.length > 0 ? {'stroke-dasharray': this.dash.join(' ')} : {},
            ...this.globalAlpha < 1 ? {'stroke-opacity': this.globalAlpha.toFixed(3)} : {},
            ...this.lineJoin !== 'miter' ? {'stroke-linejoin': this.lineJoin} : {}};
    }

    element(name, attributes, content) {
        const written = Object.entries(attributes).map(([key, value]) => ` ${key}="${value}"`).join('');
        this.text += `<${name}${written}` + (content === undefined ? '/>\n' : `>${content}</${name}>\n`);
    }
}

function rectangle(x, y, width, height) {
    return {x: pixels(x), y: pixels(y), width: pixels(width), height: pixels(height)};
}
