// The picture that the button of the page saves: a file that shows the map by itself.

const assert = require('node:assert');
const fs = require('node:fs');

module.exports = ({stream, view, save, openFile, withPage, targetOnMap}) => {
    // What a saved picture holds, as Chromium reads it.
    async function read(file) {
        const {page, complaints, requests} = await openFile(file);
        const found = await page.evaluate(() => ({
            root: document.documentElement.nodeName,
            title: document.querySelector('svg > title').textContent,
            words: [...document.querySelectorAll('text')].map(one => one.textContent),
            kinds: [...new Set([...document.querySelectorAll('*')].map(one => one.nodeName))].sort(),
            targets: [...document.querySelectorAll('.target')].map(one => {
                one.querySelectorAll('path').forEach(path => { // lines of speeds and bolts are not of the mark
                    if (/^M[^MAZ]*$/.test(path.getAttribute('d'))) {
                        path.remove();
                    }
                });
                const {x, y, width, height} = one.getBBox();
                return {title: one.querySelector('title').textContent, x: x + width / 2, y: y + height / 2};
            }),
        }));
        await page.context().close();
        assert.deepStrictEqual(complaints, []);
        assert.strictEqual(requests.length, 1);
        return found;
    }

    const ofSensor = (frame, name) => frame.targets.filter(one => one.sensor === name);

    return {
        async 'the saved picture has a title, the legend, and a mark at the place of every target'() {
            for (const [pipeline, number] of [['two-vehicles', 1], ['intersection', 40], ['ghosts', 60]]) {
                const frames = stream(pipeline);
                const frame = frames.find(one => one.frame === number);
                const scene = frame.scene.replace('/ego', '');
                await withPage(view(frames, '--frame', String(number)), async page => {
                    await page.keyboard.press('a');
                    const file = await save(page, `${scene}-${number}.svg`);
                    const {root, title, words, kinds, targets} = await read(file);
                    assert.strictEqual(root, 'svg');
                    assert.deepStrictEqual(kinds.filter(kind => !['g', 'path', 'rect', 'svg', 'text', 'title'].includes(kind)), []);
                    assert.doesNotMatch(fs.readFileSync(file, 'utf8'), /NaN|undefined|null|href|url\(|@font|style=/);
                    assert.ok(title.includes(`${scene}, frame ${number} of `) && title.endsWith(`, at ${frame.time_s.toFixed(3)} s`), title);
                    const echoed = frame.targets.filter(one => !['clutter', 'false_alarm'].includes(one.contributors[0].path));
                    assert.ok(title.includes(`: ${echoed.length} target`), title);
                    assert.ok(words.includes(title));
                    for (const told of await page.locator('#legend > :is(div, label)').allInnerTexts()) {
                        assert.ok(words.includes(told.trim()), told);
                    }
                    assert.strictEqual(targets.length, frame.targets.length);
                    for (const sensor of frame.sensors.list) {
                        const marks = targets.filter(one => one.title.startsWith(sensor.name + ' '));
                        assert.strictEqual(marks.length, ofSensor(frame, sensor.name).length);
                        for (const [i, target] of ofSensor(frame, sensor.name).entries()) {
                            const mark = marks.find(one => one.title.startsWith(`${sensor.name} ${i + 1}: `));
                            assert.ok(mark.title.includes(`: ${target.range_m.toFixed(2)} m, `), mark.title);
                            const at = await targetOnMap(page, frame, target);
                            assert.ok(Math.hypot(mark.x - at.x, mark.y - at.y) < 2.5, `${mark.title}: ${mark.x}, ${mark.y}, expected ${at.x}, ${at.y}`);
                        }
                    }
                });
            }
        },

        async 'a key saves what is switched on and chosen, as the map shows it, and leaves the map as it is'() {
            const frames = stream('intersection');
            const frame = frames.find(one => one.frame === 40);
            await withPage(view(frames, '--frame', '40'), async page => {
                await page.click('#legend input >> nth=0');
                const shown = ofSensor(frame, 'right');
                await page.selectOption('#up', 'right');
                await page.evaluate(() => { zoomBy(6, 0, 0); draw(); });
                const outside = await page.innerText('#outside');
                await page.evaluate(() => document.activeElement.blur());
                const image = () => page.evaluate(() => { draw(); return canvas.toDataURL(); });
                const before = await image();
                const file = await save(page, 'intersection-40.svg', () => page.keyboard.press('s'));
                assert.strictEqual(await image(), before);
                const {targets, title: told} = await read(file);
                assert.match(outside, /^\d+ targets? off the map$/);
                assert.ok(told.endsWith('; ' + outside), told);
                assert.strictEqual(targets.length, shown.length);
                for (const {title, x, y} of targets) {
                    const number = Number(/^right (\d+):/.exec(title)[1]);
                    const at = await targetOnMap(page, frame, shown[number - 1]);
                    assert.ok(Math.hypot(x - at.x, y - at.y) < 2.5, title);
                }
            });
        },
    };
};
