// What a person does with the page of glint-view, done by Chromium, and what must then be there. All
// expected values come from the stream itself, never from the page's own data.

const assert = require('node:assert');
const {execFileSync, spawnSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {launch, open} = require('./browser.js');

const [, , work, ...wanted] = process.argv;
const root = path.join(__dirname, '..', '..');
let browser;

function stream(pipeline) {
    const text = execFileSync('glint', [path.join(root, 'pipelines', pipeline + '.sh')],
        {maxBuffer: 1 << 28, cwd: root});
    return text.toString().trim().split('\n').map(line => nameLost(JSON.parse(line)));
}

// Gives each lost echo its object and its path, which a line leaves out where they are those of the echo before, and direct.
function nameLost(frame) {
    for (const {echoes} of frame.lost || []) {
        echoes.forEach((echo, i) => {
            echo.object = echo.object || echoes[i - 1].object;
            echo.path = echo.path || 'direct';
        });
    }
    return frame;
}

function write(frames) {
    return frames.map(frame => JSON.stringify(frame) + '\n').join('');
}

let written = 0;

// The page of a stream of frames.
function view(frames, ...options) {
    const file = path.join(work, `view-${written++}.html`);
    const run = spawnSync('glint-view', ['-o', file, ...options], {input: write(frames)});
    assert.strictEqual(run.status, 0, String(run.stderr));
    return file;
}

const openFile = file => open(browser, file);

// The file of the picture that the page saves, when its button is clicked or otherwise, under this name.
async function save(page, name, act = () => page.click('#save')) {
    const [download] = await Promise.all([page.waitForEvent('download'), act()]);
    assert.strictEqual(download.suggestedFilename(), name);
    const file = path.join(work, `picture-${written++}.svg`);
    await download.saveAs(file);
    return file;
}

// A page that must stay silent and alone.
async function withPage(file, use, options, expected = []) {
    const opened = await open(browser, file, options);
    await use(opened.page);
    assert.deepStrictEqual(opened.complaints.filter(text => !expected.some(one => one.test(text))), []);
    const fetched = opened.requests.filter(url => url.split('#')[0] !== 'file://' + file);
    assert.deepStrictEqual(fetched, []);
    await opened.page.context().close();
}

const panelText = page => page.innerText('#panel');
const clock = page => page.innerText('#clock');

async function clickMap(page, place) {
    const box = await page.locator('#map').boundingBox();
    await page.mouse.click(box.x + place.x, box.y + place.y);
}

// Where the page should have drawn a place, from the frame, the camera and nothing else.
function targetOnMap(page, frame, target) {
    const sensor = frame.sensors.list.find(one => one.name === target.sensor);
    const ahead = sensor.mount_x_m + target.range_m * Math.cos(target.azimuth_rad + sensor.mount_yaw_rad);
    const left = sensor.mount_y_m + target.range_m * Math.sin(target.azimuth_rad + sensor.mount_yaw_rad);
    return page.evaluate(([x, y]) => {
        const along = (x - camera.x) * camera.scale;
        const across = (y - camera.y) * camera.scale;
        const middle = {x: canvas.clientWidth / 2, y: canvas.clientHeight / 2};
        return state.up === 'up' ? {x: middle.x - across, y: middle.y - along}
            : {x: middle.x + along, y: middle.y - across};
    }, [ahead, left]);
}

async function pixelAt(page, at) {
    return page.evaluate(({x, y}) => {
        draw();
        const ratio = window.devicePixelRatio;
        return [...pen.getImageData(Math.round(x * ratio), Math.round(y * ratio), 1, 1).data];
    }, at);
}

// A frame in which the left sensor's targets are well apart from everything else.
function richFrame(frames) {
    return frames.find(frame => frame.targets.filter(one => one.sensor === 'left').length === 3);
}

const corner = stream('corner');
const intersection = stream('intersection');

const tests = {
    async 'the first look shows three targets of one car and what got lost'() {
        for (const frames of [corner, intersection]) {
            await withPage(view(frames), async page => {
                const text = await panelText(page);
                assert.match(text, /\(?car\)?/);
                assert.match(text, /: 3 targets/);
                assert.match(text, /echo(es)? lost/);
                assert.match(text, /dB too weak/);
                assert.match(await page.innerText('#legend'), /target of left/);
            });
        }
    },

    async 'where one sensor has three targets and lacks a fourth, that is shown first'() {
        await withPage(view(stream('side')), async page => {
            assert.match(await panelText(page), /: 3 targets, 1 echo lost/);
        });
    },

    async 'a click on a target tells its label'() {
        const frame = richFrame(corner);
        const target = frame.targets.filter(one => one.sensor === 'left')[2];
        await withPage(view(corner, '--frame', String(frame.frame)), async page => {
            await clickMap(page, await targetOnMap(page, frame, target));
            const text = await panelText(page);
            assert.match(text, /Target 3 of left/);
            assert.ok(text.includes(`${target.range_m.toFixed(3)} m`), text);
            assert.ok(text.includes(`${target.cell_range_m.toFixed(3)} m`), text);
            assert.ok(text.includes(`${target.amplitude_db.toFixed(2)} dB`), text);
            for (const one of target.contributors) {
                assert.ok(text.includes(`${one.reflector} of ${one.object}, ${one.path}`), text);
                assert.ok(text.includes(`${(100 * one.weight).toFixed(1)} %`), text);
            }
        });
    },

    async 'a target stands beside its neighbours, in metres and in cells of the radar'() {
        const frame = corner.find(one => one.frame === 114);
        const sensor = frame.sensors.list.find(one => one.name === 'left');
        const leaders = frame.targets.filter(one => one.sensor === 'left').map(one => one.contributors[0]);
        const apart = (name, from, to) => Math.abs(leaders[from][name] - leaders[to][name]);
        const part = (value, cell, unit) => `${value.toFixed(2)} ${unit} = ${(value / cell / 2).toFixed(1)} cells`;
        assert.ok(leaders[0].range_m < leaders[1].range_m && leaders[1].range_m < leaders[2].range_m);
        const farther = (from, to) => leaders[from].range_rate_mps > leaders[to].range_rate_mps;
        assert.ok(farther(0, 1) && farther(1, 2));
        await withPage(view([frame]), async page => {
            assert.ok((await panelText(page)).includes(
                `${part(apart('range_m', 2, 1), sensor.resolution_range_m, 'm')} behind target\u00a02`));
            await page.keyboard.press('n');
            await page.keyboard.press('n');
            const text = await panelText(page);
            assert.match(text, /Why are these apart\?/);
            for (const [other, words] of [[0, 'behind target\u00a01'], [2, 'in front of target\u00a03']]) {
                const range = part(apart('range_m', 1, other), sensor.resolution_range_m, 'm');
                const rate = part(apart('range_rate_mps', 1, other), sensor.resolution_range_rate_mps, 'm/s');
                assert.ok(text.includes(`${range} ${words}`), `${range} ${words}: ${text}`);
                assert.ok(text.includes(`${rate} of rate ${other === 0 ? 'below' : 'above'} it`), `${rate}: ${text}`);
            }
            await page.click('#panel .row:has-text("behind target 1")');
            assert.match(await panelText(page), /Target 1 of left/);
        });
    },

    async 'an array tells in its beams how far apart targets are, a stream without cells does not'() {
        const frame = stream('array')[0];
        const {azimuth_cell_rad: beam} = frame.sensors.list[0];
        const [one, other] = frame.targets.filter(target => target.contributors[0].path === 'direct');
        const angle = Math.abs(one.cell_azimuth_rad - other.cell_azimuth_rad);
        const told = `${(angle * 180 / Math.PI).toFixed(1)}° = ${(angle / beam).toFixed(1)} cells`;
        const bare = structuredClone(frame);
        bare.sensors.list.forEach(sensor => { delete sensor.resolution_range_m; delete sensor.resolution_range_rate_mps; });
        for (const [frames, tells] of [[[frame], true], [[bare], false]]) {
            await withPage(view(frames), async page => {
                await page.evaluate(number => chooseTarget(number), frame.targets.indexOf(one));
                assert.strictEqual((await panelText(page)).includes(told), tells);
            });
        }
    },

    async 'a target has its elevation in panel and tooltip, if its sensor measures it'() {
        const frame = {...structuredClone(corner.find(one => one.frame === 114))};
        const [high, flat] = frame.targets.filter(one => one.sensor === 'left');
        Object.assign(high, {elevation_rad: 0.05, cell_elevation_rad: -0.02});
        await withPage(view([frame]), async page => {
            const words = target => page.evaluate(number => targetWords(0, number), frame.targets.indexOf(target));
            assert.match(await words(high), /° off boresight, 2\.9° up, /);
            assert.doesNotMatch(await words(flat), /° up/);
            await page.evaluate(number => chooseTarget(number), frame.targets.indexOf(high));
            assert.match(await panelText(page), /elevation\s+2\.86°\s+-1\.15°/);
            await page.evaluate(number => chooseTarget(number), frame.targets.indexOf(flat));
            assert.doesNotMatch(await panelText(page), /elevation/);
        });
    },

    async 'the first look says what to click, the click tells the cell and puts the target on top'() {
        await withPage(view(corner, '--frame', '114'), async page => {
            assert.match(await panelText(page), /Click a target to see what it is made of/);
            await page.click('#panel .row >> nth=0');
            const frame = corner.find(one => one.frame === 114);
            const target = frame.targets.find(one => one.sensor === 'left');
            const {cell_range_m: range, cell_range_rate_mps: rate} = frame.sensors.list.find(one => one.name === 'left');
            assert.ok((await panelText(page)).includes(`The radar’s cell: ${range} m (dashed arcs on the map) by ${rate} m/s`));
            const near = frame.targets.find(one => one.sensor === 'right');
            const [at, other] = [await targetOnMap(page, frame, target), await targetOnMap(page, frame, near)];
            assert.ok(Math.hypot(at.x - other.x, at.y - other.y) < 6); // they lie over each other
            assert.deepStrictEqual(await pixelAt(page, at), [0x00, 0x72, 0xb2, 255]);
            await page.keyboard.press('Escape');
            assert.doesNotMatch(await panelText(page), /Click a target to see/);
        });
    },

    async 'help opens at its beginning and within the window, however small that is'() {
        for (const [width, height] of [[1280, 400], [1280, 800], [320, 640], [400, 800]]) {
            await withPage(view(corner), async page => {
                await page.click('#help');
                assert.strictEqual(await page.evaluate(() => control('keys').scrollTop), 0);
                assert.strictEqual(await page.evaluate(() => document.activeElement.textContent), 'What you see');
                const sheet = await page.locator('#keys').boundingBox();
                assert.ok(sheet.x >= 0 && sheet.x + sheet.width <= width);
                assert.ok(await page.evaluate(() => control('keys').scrollWidth <= control('keys').clientWidth));
                await page.keyboard.press('Escape');
                assert.ok(await page.isHidden('#keys'));
            }, {viewport: {width, height}});
        }
    },

    async 'a tap on a target does the same'() {
        const frame = richFrame(corner);
        const target = frame.targets.find(one => one.sensor === 'left');
        await withPage(view(corner, '--frame', String(frame.frame)), async page => {
            const box = await page.locator('#map').boundingBox();
            const at = await targetOnMap(page, frame, target);
            await page.touchscreen.tap(box.x + at.x, box.y + at.y);
            assert.match(await panelText(page), /Target \d of (left|right)/);
        }, {hasTouch: true, viewport: {width: 420, height: 800}});
    },

    async 'a click on a reflection centre tells why it was lost'() {
        const frame = corner.find(one => one.lost.some(group => group.reason === 'below_threshold') &&
            one.targets.length > 3);
        const group = frame.lost.find(one => one.reason === 'below_threshold');
        const echo = group.echoes[0];
        await withPage(view(corner, '--frame', String(frame.frame)), async page => {
            await page.click(`.lost >> text=${echo.reflector}`);
            const text = await panelText(page);
            assert.match(text, new RegExp(`${echo.reflector} of ${echo.object}`));
            assert.match(text, /Lost in sensor, direct\./);
            assert.ok(text.includes(`${echo.shortfall_db.toFixed(2)} dB below the detection threshold`), text);
        });
    },

    async 'a blocked reflection centre names who stands in the way'() {
        const frame = intersection.find(one => one.lost.some(group => group.reason === 'blocked'));
        const {object, by} = frame.lost.find(group => group.reason === 'blocked').echoes[0];
        await withPage(view(intersection, '--frame', String(frame.frame)), async page => {
            await page.evaluate(id => chooseObject(names.indexOf(id)), object);
            assert.ok((await panelText(page)).includes(`blocked by ${by}`));
        });
    },

    async 'it plays, pauses, steps and scrubs'() {
        await withPage(view(corner, '--frame', '0'), async page => {
            assert.match(await clock(page), /^frame 0 \(1\/131\), 0\.000 s/);
            await page.click('#play');
            await page.waitForFunction(() => state.row >= 5);
            await page.click('#play');
            const stopped = await clock(page);
            await page.waitForTimeout(150);
            assert.strictEqual(await clock(page), stopped);
            await page.fill('#scrub', '57');
            assert.match(await clock(page), /^frame 57 \(58\/131\), 2\.280 s/);
            await page.click('#forward');
            await page.click('#back');
            await page.click('#back');
            assert.match(await clock(page), /^frame 56 /);
        });
    },

    async 'it plays to the end and stops there'() {
        await withPage(view(corner, '--frame', '128'), async page => {
            await page.click('#play');
            await page.waitForFunction(() => !state.playing);
            assert.match(await clock(page), /\(131\/131\)/);
        });
    },

    async 'keys do what buttons do'() {
        await withPage(view(corner, '--frame', '60'), async page => {
            const press = async (key, expected) => {
                await page.keyboard.press(key);
                assert.ok(await page.evaluate(expected), `${key}: ${expected}`);
            };
            await press('ArrowRight', 'state.row === 61');
            await press('Shift+ArrowLeft', 'state.row === 51');
            await press('End', 'state.row === 130');
            await press('n', 'state.target >= 0 || scansOf(state.frame).end === 0');
            await press('Home', 'state.row === 0 && state.target === -1');
            await press('x', 'state.up === "right"');
            await press('f', 'state.follow === false');
            await press('v', 'state.rates === "compensated"');
            await press('t', 'state.trail === false');
            await press('d', 'isDark()');
            await press('Space', 'state.playing');
            await press('Space', '!state.playing');
            await press('?', 'document.getElementById("keys").open');
        });
    },

    async 'arrow keys step after a button was pressed'() {
        await withPage(view(corner, '--frame', '60'), async page => {
            await page.click('#forward');
            await page.keyboard.press('ArrowRight');
            assert.match(await clock(page), /^frame 62 /);
            await page.click('#follow');
            await page.keyboard.press('ArrowLeft');
            assert.match(await clock(page), /^frame 61 /);
        });
    },

    async 'the keyboard walks through the panel without losing its place'() {
        await withPage(view(corner, '--frame', '114'), async page => {
            await page.keyboard.press('Tab');
            await page.focus('#panel .row');
            await page.keyboard.press('Enter');
            assert.match(await panelText(page), /^.*all of this object/);
            assert.ok(await page.evaluate(() => document.getElementById('panel').contains(document.activeElement)));
            await page.keyboard.press('Enter');
            assert.doesNotMatch(await panelText(page), /all of this object/);
        });
    },

    async 'a press in the panel pauses and is a click'() {
        const rows = corner.filter(frame => frame.frame >= 100);
        await withPage(view(rows, '--frame', '100'), async page => {
            await page.selectOption('#pace', '0.25');
            await page.click('#play');
            const place = await page.evaluate(() => {
                const box = document.querySelector('#panel .row').getBoundingClientRect();
                return {x: box.x + 60, y: box.y + 8};
            });
            await page.mouse.move(place.x, place.y);
            await page.mouse.down();
            await page.waitForTimeout(400);
            await page.mouse.up();
            assert.match(await panelText(page), /Target 1 of left/);
            assert.ok(await page.evaluate(() => !state.playing));
        });
    },

    async 'speeds over ground fit their plot'() {
        await withPage(view(stream('highway')), async page => {
            for (const rates of ['raw', 'compensated']) {
                await page.selectOption('#rates', rates);
                await page.evaluate(() => draw());
                const hits = await page.evaluate(() => plots.rate.hits.map(hit => hit.x));
                const width = await page.evaluate(() => plots.rate.canvas.clientWidth);
                assert.ok(hits.length > 0 && hits.every(x => x > 0 && x < width), `${rates}: ${hits}`);
            }
        });
    },

    async 'objects have colours of their own'() {
        const made = new Set(intersection.flatMap(frame => frame.targets.map(target => target.contributors[0].object)));
        await withPage(view(intersection), async page => {
            await page.selectOption('#colour', 'object');
            const counts = await page.evaluate(ids => {
                const colours = ids.map(id => objectColour(names.indexOf(id)));
                return ink.palette.map(one => colours.filter(colour => colour === one).length);
            }, [...made]);
            assert.strictEqual(counts.reduce((sum, count) => sum + count), made.size);
            assert.ok(Math.max(...counts) - Math.min(...counts) <= 1, String(counts));
        });
    },

    async 'missing frames are told'() {
        const frames = corner.filter(frame => frame.frame < 20 || frame.frame > 60);
        await withPage(view(frames), async page => {
            assert.match(await page.innerText('#notice'), /^41 frames between its first and its last/);
        });
    },

    async 'every colouring draws'() {
        await withPage(view(intersection), async page => {
            for (const scheme of ['light', 'dark']) {
                await page.emulateMedia({colorScheme: scheme});
                for (const colour of ['sensor', 'object', 'rate', 'amplitude', 'path']) {
                    await page.selectOption('#colour', colour);
                    await page.evaluate(() => draw());
                }
            }
        });
    },

    async 'the effects that changed targets are on the menu, and none of them at first'() {
        const occurring = new Set(corner.flatMap(frame => frame.targets.flatMap(target => target.effects)));
        const words = [...occurring].map(effect => effect.replace(/_/g, ' '));
        assert.ok(words.length > 2);
        await withPage(view(corner), async page => {
            const options = await page.locator('#effect option').allInnerTexts();
            assert.deepStrictEqual(options.slice(1).sort(), words.sort());
            assert.strictEqual(await page.inputValue('#effect'), '-1');
            for (let i = 0; i < options.length; i++) {
                await page.keyboard.press('e');
                await page.evaluate(() => draw());
            }
            assert.strictEqual(await page.inputValue('#effect'), '-1');
        });
    },

    async 'targets that an effect changed stand out from those it did not'() {
        const apart = frame => frame.targets.filter(one => one.sensor === 'left');
        const frame = intersection.find(one => apart(one).some(target => target.effects.includes('merging')) &&
            apart(one).some(target => !target.effects.includes('merging')));
        await withPage(view(intersection, '--frame', String(frame.frame)), async page => {
            await page.keyboard.press('Escape');
            await page.keyboard.press('Escape');
            await page.selectOption('#effect', {label: 'merging'});
            assert.match(await page.innerText('#legend'), /changed by merging/);
            for (const target of apart(frame)) {
                const colour = await page.evaluate(number => colourOf(scanOfSensor(state.frame, 'left'),
                    targetsOf(scanOfSensor(state.frame, 'left')).begin + number), apart(frame).indexOf(target));
                assert.strictEqual(colour, target.effects.includes('merging') ? '#c74e00' : '#7b8490');
            }
        });
    },

    async 'a ghost is hollow and tells its way'() {
        const frame = structuredClone(richFrame(corner));
        const target = frame.targets.filter(one => one.sensor === 'left')[2];
        const [leader] = target.contributors;
        Object.assign(leader, {path: 'wall_object', mirror: 'house'});
        target.effects = ['merging', 'list_limit'];
        await withPage(view([{...frame, sections: undefined, lost: undefined, counts: undefined, last: true}]),
            async page => {
                await page.keyboard.press('Escape');
                await page.keyboard.press('Escape');
                const at = await targetOnMap(page, frame, target);
                assert.deepStrictEqual(await pixelAt(page, at), [255, 255, 255, 255]);
                await clickMap(page, at);
                const text = await panelText(page);
                assert.match(text, /Target 3 of left, a ghost/);
                assert.match(text, /Effects that changed it: merging, list limit\./);
                assert.ok(text.includes(`${leader.reflector} of ${leader.object}, ` +
                    'ghost: radar → house → it → radar'), text);
                assert.match(await page.innerText('#legend'), /ghost: seen by way of a mirror/);
            });
        await withPage(view(corner), async page => {
            assert.doesNotMatch(await page.innerText('#legend'), /ghost/);
        });
    },

    async 'echoes of no object are targets like all others'() {
        const frame = structuredClone(richFrame(corner));
        frame.targets.forEach((target, i) => target.contributors.forEach((one, number) => Object.assign(one, {
            object: i % 2 ? 'clutter' : 'noise', reflector: 'echo', number: number + 1,
            path: i % 2 ? 'clutter' : 'false_alarm',
        })));
        await withPage(view([{...frame, sections: undefined, lost: undefined, counts: undefined, last: true}]),
            async page => {
                for (const colour of ['sensor', 'object', 'rate', 'amplitude', 'path']) {
                    await page.selectOption('#colour', colour);
                    await page.evaluate(() => draw());
                }
                await page.focus('#map');
                await page.keyboard.press('n');
                assert.match(await panelText(page), /echo of noise, nothing but noise, no\. 1/);
                await page.keyboard.press('n');
                assert.match(await panelText(page), /echo of clutter, the ground or roadside, no\. 1/);
                await page.click('#panel .row');
                assert.match(await panelText(page), /echo of clutter \(not in this frame\)/);
                await page.keyboard.press('Escape');
                assert.match(await panelText(page), /clutter \(not in this frame\)/);
            });
    },

    async 'what was lost names the effect that lost it'() {
        const frame = intersection.find(one => one.lost.some(group => group.reason === 'blocked'));
        const {object, reflector} = frame.lost.find(group => group.reason === 'blocked').echoes[0];
        await withPage(view(intersection, '--frame', String(frame.frame)), async page => {
            await page.evaluate(id => chooseObject(names.indexOf(id)), object);
            assert.match(await panelText(page), /blocked by \S+\s+occlusion/);
            assert.match(await panelText(page), /(facing away|mirroring past the sensor) \((visibility|plane reflection)\)/);
            await page.evaluate(name => chooseReflector(name), reflector);
            assert.match(await panelText(page), /stands in the way\. \(occlusion\)/);
        });
    },

    async 'over ground, what is parked stands still'() {
        const frame = intersection.find(one => one.targets.some(target =>
            target.contributors.length === 1 && target.contributors[0].object.startsWith('parked')));
        const target = frame.targets.find(one =>
            one.contributors.length === 1 && one.contributors[0].object.startsWith('parked'));
        assert.ok(Math.abs(target.range_rate_mps) > 3);
        await withPage(view(intersection, '--frame', String(frame.frame)), async page => {
            const rate = await page.evaluate(([sensor, number]) => {
                const scan = scanOfSensor(state.frame, sensor);
                return rateOf(scan, targetsOf(scan).begin + number, true);
            }, [target.sensor, frame.targets.filter(one => one.sensor === target.sensor).indexOf(target)]);
            assert.ok(Math.abs(rate) < 1.5, String(rate));
        });
    },

    async 'an empty stream says so'() {
        await withPage(view([]), async page => {
            assert.match(await page.innerText('#empty'), /The stream is empty/);
            await page.keyboard.press('Space');
            await page.click('#map');
            await page.emulateMedia({colorScheme: 'dark'});
            await page.click('#help');
        });
    },

    async 'one frame is enough'() {
        await withPage(view([{...corner[100], last: true}]), async page => {
            assert.match(await clock(page), /^frame 100 \(1\/1\)/);
            await page.click('#play');
            assert.ok(await page.evaluate(() => !state.playing));
            assert.ok(await page.isHidden('#notice'));
        });
    },

    async 'a frame with 500 targets is drawn and listed'() {
        const frame = structuredClone(richFrame(corner));
        const model = frame.targets.find(one => one.sensor === 'left');
        frame.targets = Array.from({length: 500}, (_, i) => ({
            ...model, range_m: 1 + i / 20, azimuth_rad: Math.sin(i), amplitude_db: 40 - i / 20,
        }));
        await withPage(view([{...frame, sections: undefined, lost: undefined, counts: undefined, last: true}]),
            async page => {
                await page.keyboard.press('Escape');
                assert.match(await panelText(page), /left: 500 targets/);
                assert.match(await panelText(page), /and 200 more/);
                const time = await page.evaluate(() => {
                    const begin = performance.now();
                    draw();
                    return performance.now() - begin;
                });
                assert.ok(time < 2000, `${time} ms`);
            });
    },

    async 'interleaved scenes are told apart'() {
        const side = stream('side');
        const mixed = [];
        for (let i = 0; i < Math.max(corner.length, side.length); i++) {
            mixed.push(...[corner[i], side[i]].filter(Boolean));
        }
        await withPage(view(mixed), async page => {
            const options = await page.locator('#scene option').allInnerTexts();
            assert.deepStrictEqual(options, [corner[0].scene, side[0].scene]);
            assert.match(await clock(page), new RegExp(`/${corner.length}\\)`));
            await page.selectOption('#scene', '1');
            assert.match(await clock(page), new RegExp(`/${side.length}\\)`));
            assert.ok(await page.isHidden('#notice'));
        });
    },

    async 'a shuffled stream plays in order'() {
        await withPage(view([...corner.slice(60), ...corner.slice(0, 60).reverse()]), async page => {
            await page.keyboard.press('Home');
            assert.match(await clock(page), /^frame 0 \(1\/131\), 0\.000 s/);
            await page.keyboard.press('Shift+ArrowRight');
            assert.match(await clock(page), /^frame 10 \(11\/131\), 0\.400 s/);
        });
    },

    async 'names that look like markup stay names'() {
        const evil = '</script><script>window.broken=1</script><img src=x onerror=window.broken=1>';
        const frame = richFrame(corner);
        const text = write([{...frame, last: true}])
            .replaceAll('"car"', JSON.stringify(evil))
            .replaceAll('"corner-approach/ego"', '"<script>alert(1)</script>"')
            .replaceAll('"left"', '"<!--<script>"');
        const frames = [JSON.parse(text)];
        frames[0].objects.forEach(object => { object.class = 'car'; });
        await withPage(view(frames), async page => {
            assert.strictEqual(await page.evaluate(() => window.broken), undefined);
            assert.ok((await panelText(page)).includes(evil));
            assert.ok((await page.innerText('#legend')).includes('target of <!--<script>'));
            assert.strictEqual(await page.innerText('#scene-name'), '<script>alert(1)</script>');
            const {page: picture} = await openFile(await save(page, '-script-alert-1-script--114.svg'));
            assert.strictEqual(await picture.evaluate(() => document.querySelectorAll('script, img').length), 0);
            const told = await picture.evaluate(() => document.documentElement.textContent);
            assert.ok(told.includes('<script>alert(1)</script>') && told.includes('target of <!--<script>') && told.includes(evil));
        });
    },

    async 'a cut stream is told'() {
        await withPage(view(corner.slice(0, 40)), async page => {
            assert.match(await page.innerText('#notice'), /ends before its last frame/);
        });
        const whole = write(corner.slice(0, 3));
        const file = path.join(work, 'cut.html');
        const run = spawnSync('glint-view', ['-o', file], {input: whole.slice(0, -200)});
        assert.strictEqual(run.status, 65);
        assert.match(String(run.stderr), /stdin:3: /);
        assert.ok(!fs.existsSync(file));
    },

    async 'a stream without account says what to do'() {
        const frames = corner.map(frame => ({...frame, sections: undefined, lost: undefined, counts: undefined}));
        await withPage(view(frames, '--frame', '110'), async page => {
            assert.match(await panelText(page), /give --sections account to glint-ideal/);
        });
    },

    async 'the panel of an object tells how much of it each sensor has in view'() {
        const told = {sensor: 'left', object: 'parked_2', reflectors: 12, in_range: 5, in_view: 4,
            blocked_share: 0.5, visibility: 'v40-60', detections: 2, merged: 1, ghosts: 3};
        const bare = {sensor: 'left', object: 'parked_3', reflectors: 1, in_range: 1};
        const frame = {...intersection[40], sections: ['objects', 'visibility'], visibility: [told, bare],
            lost: undefined, counts: undefined, last: true};
        await withPage(view([frame]), async page => {
            const words = async id => {
                await page.evaluate(name => chooseObject(names.indexOf(name)), id);
                return panelText(page);
            };
            assert.ok((await words('parked_2')).includes('5 of 12 reflection centres in range, 4 in view, ' +
                '50 % of these blocked (visibility 40 to 60 %). 2 detections, 1 merged with something else, 3 ghosts.'));
            assert.ok((await words('parked_3')).includes(
                '1 of 1 reflection centre in range, 0 in view. 0 detections.'));
            assert.doesNotMatch(await words('bus'), /in view/);
        });
    },

    async 'every sighting of a chain is on the page'() {
        const chain = 'glint-traffic intersection --sections visibility | glint-extract' +
            ' | glint-ideal --sensors srr24-pair | glint-sensor | glint-noise';
        const frame = JSON.parse(execFileSync('glint', ['-c', chain], {maxBuffer: 1 << 28, cwd: root})
            .toString().split('\n')[40]);
        await withPage(view([{...frame, last: true}]), async page => {
            for (const one of frame.visibility.filter(sighting => sighting.sensor === 'left')) {
                await page.evaluate(name => chooseObject(names.indexOf(name)), one.object);
                const [, range, all, inView] = (await panelText(page)).match(/(\d+) of (\d+) reflection.*, (\d+) in view/);
                assert.deepStrictEqual([range, all, inView].map(Number),
                    [one.in_range || 0, one.reflectors, one.in_view || 0], one.object);
            }
        });
    },

    async 'reflection centres are those of the stream, whatever documents there are'() {
        const frames = structuredClone(corner.slice(100));
        frames.forEach(frame => { frame.objects[1].class = 'hovercraft'; });
        await withPage(view(frames), async page => {
            const spots = await page.evaluate(() => [...spotsOf(state.object).keys()].map(one => names[one]));
            assert.deepStrictEqual(spots.sort(), [...new Set(frames.flatMap(frame => frame.lost
                .filter(group => ['facing_away', 'no_specular_point'].includes(group.reason))
                .flatMap(group => group.echoes.map(one => one.reflector))))].sort());
        });
    },

    async 'a scene without sensors is shown'() {
        const text = execFileSync('glint-traffic', ['intersection'], {cwd: root, maxBuffer: 1 << 28});
        const frames = text.toString().trim().split('\n').map(line => JSON.parse(line));
        await withPage(view(frames), async page => {
            assert.match(await panelText(page), /no sensors/);
        });
    },

    async 'a browser that cannot decode base64 by itself opens it too'() {
        const {page, complaints} = await open(browser, view(corner), {},
            () => { delete Uint8Array.fromBase64; });
        assert.match(await panelText(page), /: 3 targets/);
        assert.deepStrictEqual(complaints, []);
    },

    async 'asking for what is not there fails'() {
        const run = spawnSync('glint-view', ['--frame', '4000'], {input: write(corner.slice(0, 5))});
        assert.strictEqual(run.status, 65);
    },
};

Object.assign(tests, require('./whole_scene.js')(
    {stream, view, withPage, targetOnMap, clickMap, panelText, clock}),
require('./comparison.js')({work, write, view, withPage}), require('./picture.js')({stream, view, save, openFile, withPage, targetOnMap}), require('./robust.js')({work, stream, view, withPage}),
require('./truth.js')({stream, view, withPage, panelText}),
require('./events.js')({stream, view, withPage, targetOnMap, panelText, clock}));

async function main() {
    browser = await launch();
    let failed = 0;
    for (const [name, test] of Object.entries(tests)) {
        if (wanted.length > 0 && !wanted.some(word => name.includes(word))) {
            continue;
        }
        try {
            await test();
        } catch (error) {
            failed++;
            console.log(`FAILED: ${name}\n${error.stack}`);
        }
    }
    await browser.close();
    console.log(failed ? `${failed} browser tests failed` : 'browser tests: passed');
    process.exitCode = failed ? 1 : 0;
}

main();
