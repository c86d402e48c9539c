// The map as a picture: one SVG file with the frame in words above, the map as it is shown, and the legend
// beside it. It needs no style, font or script of its own.

const pictureHead = 36; // pixels above the map
const meaningHeight = 22; // of a line of the legend

// Paints something into a box of the picture, which cuts off what lies outside.
function pictureBox(x, y, {width, height}, paint) {
    const drawing = new SvgPen();
    paint(drawing);
    return `<svg x="${pixels(x)}" y="${pixels(y)}" width="${pixels(width)}" height="${pixels(height)}">\n` +
        `${drawing.text}</svg>\n`;
}

function paintMap(drawing) {
    pen = drawing;
    drawLayers();
    pen = canvasPen;
}

function pictureWords(drawing, text, x, y, colour, bold) {
    drawing.font = mapFont(bold ? 14 : 12.5, bold);
    drawing.fillStyle = colour;
    drawing.fillText(text, x, y);
}

function pictureLegend(left, top) {
    return legendMeanings().map(({paint, text}, i) => {
        const y = top + meaningHeight * i;
        const words = new SvgPen();
        pictureWords(words, text, left + 26, y + 8, ink.ink);
        return pictureBox(left, y, {width: 18, height: 16}, paint) + words.text;
    }).join('');
}

// The length of the longest of these texts.
function longest(texts, size, bold) {
    canvasPen.font = mapFont(size, bold);
    return Math.max(...texts.map(text => canvasPen.measureText(text).width));
}

function pictureTitle() {
    const time = head.scenes[state.scene].start_s + column('frame_time_s')[state.frame];
    return [`${frameSentence()}, at ${round(time, 3)} s`, outsideWords()].filter(Boolean).join('; ');
}

function picture() {
    const title = pictureTitle();
    const meanings = legendMeanings();
    const left = mapSize.width + 14;
    const width = Math.max(left + 40 + longest(meanings.map(({text}) => text), 12.5), 24 + longest([title], 14, true));
    const height = pictureHead + Math.max(mapSize.height, 24 + meaningHeight * meanings.length);
    const size = {width: Math.ceil(width), height: Math.ceil(height)};
    const drawing = new SvgPen();
    drawing.fillStyle = ink.paper;
    drawing.fillRect(0, 0, size.width, size.height);
    pictureWords(drawing, title, 12, pictureHead / 2, ink.ink, true);
    drawing.strokeStyle = ink.faint;
    drawing.lineWidth = 1;
    drawing.strokeRect(0.5, pictureHead + 0.5, mapSize.width - 1, mapSize.height - 1);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${size.width}" height="${size.height}" ` +
        `viewBox="0 0 ${size.width} ${size.height}" font-family="${fontFamily.replace(/"/g, '\'')}" role="img">\n` +
        `<title>${escaped(title)}</title>\n${drawing.text}` +
        pictureBox(0, pictureHead, mapSize, paintMap) + pictureLegend(left, pictureHead + 12) + '</svg>\n';
}

// "two-vehicles-12.svg": the scene and the number of the frame, in letters that any file system takes.
function pictureName() {
    return `${sceneWords().replace(/[^\p{L}\p{N}._-]+/gu, '-')}-${frameNumber(state.frame)}.svg`;
}

function savePicture() {
    const link = make('a');
    link.href = URL.createObjectURL(new Blob([picture()], {type: 'image/svg+xml'}));
    link.download = pictureName();
    link.click();
    URL.revokeObjectURL(link.href);
}
