// Tests of what must hold for any stream and any person: names of every kind in windows of every
// size, colours, access, and a policy that lets nothing else run.

const assert = require('node:assert');
const {execSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');
const {contrast, leastApart, ciede2000} = require('./colours.js');

const axe = fs.readFileSync(require.resolve('axe-core/axe.min.js'), 'utf8');

const names = {
    'of 300 letters': 'W'.repeat(300),
    'of 300 letters and signs': 'a_b-c.'.repeat(50),
    'from right to left': '\u0645\u0631\u0643\u0628\u0629 \u0635\u063a\u064a\u0631\u0629 '.repeat(8),
    'with marks that turn the direction': 'car\u202e\u2067evil\u2066\u202d'.repeat(12),
    'of markup': '<img src=x onerror=window.broken=1></script><b>'.repeat(6),
};

// A frame whose scene, objects, classes, sensors and reflectors have such a name.
function renamed(frame, name) {
    const fresh = structuredClone(frame);
    const as = old => old && `${old} ${name}`;
    fresh.scene = as(fresh.scene);
    fresh.ego = as(fresh.ego);
    fresh.objects.forEach(object => Object.assign(object, {id: as(object.id)}));
    fresh.sensors.list.forEach(sensor => { sensor.name = as(sensor.name); });
    fresh.counts.forEach(count => { count.sensor = as(count.sensor); });
    fresh.targets.forEach(target => {
        target.sensor = as(target.sensor);
        target.contributors.forEach(part =>
            Object.assign(part, {object: as(part.object), reflector: as(part.reflector)}));
    });
    fresh.lost.forEach(group => {
        group.sensor = as(group.sensor);
        group.echoes.forEach(echo => Object.assign(echo,
            {object: as(echo.object), reflector: as(echo.reflector)}, echo.by ? {by: as(echo.by)} : {}));
    });
    return {...fresh, frame: 0, last: true};
}

// What sticks out of the window on either side, without being scrolled or cut off by a parent.
function sticksOut() {
    const wide = document.scrollingElement.scrollWidth - window.innerWidth;
    const out = [...document.body.querySelectorAll('*')].filter(element => {
        const {left, right, width, height} = element.getBoundingClientRect();
        const inside = element.closest('#legend, .scroll, #targets, dialog, select');
        return width > 0 && height > 0 && !inside && (right > window.innerWidth + 1 || left < -1);
    });
    return [wide > 0 ? `the page by ${wide} px` : '', ...out.map(one => one.id || one.tagName)].filter(Boolean);
}

const panes = ['panel', 'targets', 'over-time'];

module.exports = ({work, stream, view, withPage}) => {
    const frames = stream('intersection');
    const busy = frames.reduce((most, one) => one.targets.length > most.targets.length ? one : most);

    const tests = {
        async 'nothing but the page\'s own script and style may run'() {
            await withPage(view([{...busy, last: true}]), async page => {
                const policy = await page.getAttribute('meta[http-equiv]', 'content');
                assert.doesNotMatch(policy, /unsafe|\*|http/);
                assert.match(policy, /default-src 'none'; style-src 'sha256-\S+'; script-src 'sha256-\S+'/);
                assert.strictEqual(await page.evaluate(() => new Promise(done => {
                    document.addEventListener('securitypolicyviolation', event => done(event.effectiveDirective));
                    const script = document.createElement('script');
                    script.textContent = 'window.broken = 1';
                    document.body.append(script);
                })), 'script-src-elem');
                assert.strictEqual(await page.evaluate(() => window.broken), undefined);
            }, {}, [/violates the following Content Security Policy/]);
        },

        async 'colours are apart for all eyes, and stand out from the paper'() {
            const close = (value, expected) => assert.ok(Math.abs(value - expected) < 1e-4, String(value));
            close(ciede2000([50, 2.6772, -79.7751], [50, 0, -82.7485]), 2.0425); // Sharma, Wu and Dalal 2005
            close(ciede2000([50, 2.5, 0], [73, 25, -18]), 27.1492);
            for (const colorScheme of ['light', 'dark']) {
                await withPage(view([{...busy, last: true}]), async page => {
                    const {palette, paper, edge} = await page.evaluate(() => ink);
                    const least = leastApart(palette);
                    assert.ok(least.distance >= 10, JSON.stringify(least));
                    assert.ok(leastApart([palette[1], edge]).distance >= 10); // changed by an effect, or not
                    for (const colour of palette) {
                        assert.ok(contrast(colour, paper) >= 3, colour);
                    }
                }, {colorScheme});
            }
        },

        async 'sensors of one colour have different shapes, and the first six all'() {
            await withPage(view([{...busy, last: true}]), async page => {
                const looks = await page.evaluate(() => Array.from({length: 24}, (_, i) =>
                    `${ink.palette[i % ink.palette.length]} ${JSON.stringify(head.shapes[i % head.shapes.length])}`));
                assert.strictEqual(new Set(looks).size, 24);
                assert.strictEqual(new Set(looks.slice(0, 6).map(look => look.slice(8))).size, 6);
            });
        },

        async 'on a phone the map comes first and is large'() {
            for (const [width, height] of [[320, 640], [400, 800]]) {
                await withPage(view(frames), async page => {
                    const map = await page.locator('#map').boundingBox();
                    assert.ok(map.y < 60, `${map.y}`);
                    assert.ok(map.height > 0.4 * height, `${map.height}`);
                    await page.keyboard.press('End');
                    const footer = await page.locator('footer').boundingBox();
                    assert.ok(footer.height < 90, `controls in two rows: ${footer.height}`);
                    await page.click('#more');
                    await page.selectOption('#colour', 'object');
                    await page.click('#more');
                }, {viewport: {width, height}});
            }
        },

        async 'on a phone the legend is a line until it is tapped, and tells then what it tells elsewhere'() {
            let everywhere;
            await withPage(view(frames), async page => {
                everywhere = await page.innerText('#legend');
                assert.match(everywhere, /reflection centre/);
            });
            for (const [width, height] of [[320, 640], [400, 800], [900, 420]]) {
                await withPage(view(frames), async page => {
                    assert.ok((await page.locator('#legend').boundingBox()).height <= 32);
                    assert.match(await page.innerText('#legend'), /^legend\s+left\s+right$/);
                    await page.tap('#legend > summary');
                    assert.strictEqual((await page.innerText('#legend')).replace(/^legend\s+/, ''), everywhere);
                    await page.tap('#legend > summary');
                    await page.keyboard.press('h');
                    assert.ok(await page.evaluate(() => control('legend').open &&
                        document.activeElement.type === 'checkbox'));
                }, {viewport: {width, height}, hasTouch: true});
            }
        },

        async 'what is not shown is not decoded'() {
            await withPage(view(frames), async page => {
                const has = name => page.evaluate(one => decoded.has(one), name);
                await page.evaluate(() => { chooseObject(-1); showPane('over-time'); });
                await page.waitForFunction(() => location.hash.includes('object=&'));
                await page.reload();
                await page.evaluate(() => draw());
                assert.ok(await has('target_range_m'));
                assert.ok(!await has('target_cell_range_m'));
                await page.keyboard.press('n');
                await page.click('[aria-controls=panel]');
                assert.ok(await has('target_cell_range_m'));
            });
        },

        async '50,000 frames open, are gone through and plotted'() {
            const scene = path.join(work, 'long.json');
            const file = path.join(work, 'long.html');
            fs.writeFileSync(scene, JSON.stringify({
                origin: 'a test', ego: 'ego', rate_hz: 100, duration_s: 499.99, objects: [
                    {id: 'ego', class: 'car', x_m: 0, y_m: 0, speed_mps: 10},
                    {id: 'leader', class: 'car', x_m: 12, y_m: 0, speed_mps: 10.01}]}));
            execSync(`glint-traffic ${scene} | glint-extract | glint-ideal --sensors srr24-pair-every-frame | ` +
                `glint-sensor | glint-noise | glint-view -o ${file}`);
            await withPage(file, async page => {
                await page.keyboard.press('End');
                assert.match(await page.innerText('#clock'), /^frame 49999 \(50000\/50000\)/);
                await page.click('[aria-controls=over-time]');
                assert.strictEqual(await page.evaluate(() => series.counts.length), 50000);
                const times = Array.from({length: 40}, (_, i) => 3200 + 1171 * i);
                assert.ok(times.filter(number => Math.fround(number / 100) > number / 100 + 1e-6).length > 5);
                for (const number of times) {
                    await page.keyboard.press('g');
                    await page.keyboard.type(`${number / 100} s`);
                    await page.keyboard.press('Enter');
                    assert.match(await page.innerText('#clock'), new RegExp(`^frame ${number} `));
                }
            });
        },

        async 'axe finds nothing in any pane, light or dark, wide or narrow'() {
            for (const options of [{}, {colorScheme: 'dark', viewport: {width: 400, height: 800}}]) {
                await withPage(view(frames), async page => {
                    await page.evaluate(axe);
                    for (const pane of panes) {
                        await page.evaluate(id => showPane(id), pane);
                        await check(page, pane);
                    }
                    await page.evaluate(() => chooseObject(-1));
                    if (!await page.evaluate(() => control('legend').open)) {
                        await page.click('#legend > summary');
                    }
                    await page.click('#switches summary');
                    await check(page, 'nothing chosen');
                    await page.click('#help');
                    await check(page, 'help');
                }, options);
            }
        },
    };

    async function check(page, where) {
        const {violations} = await page.evaluate(() => window.axe.run());
        assert.deepStrictEqual(violations.map(one =>
            `${where}: ${one.id}, ${one.nodes.map(node => node.html.slice(0, 120)).join(' | ')}`), []);
    }

    for (const [kind, name] of Object.entries(names)) {
        tests[`names ${kind} fit at 320, 400 and 1280 px`] = async () => {
            for (const width of [320, 400, 1280]) {
                await withPage(view([renamed(busy, name)]), async page => {
                    for (const pane of panes) {
                        await page.evaluate(id => { showPane(id); draw(); }, pane);
                        assert.deepStrictEqual(await page.evaluate(sticksOut), [], `${pane} at ${width} px`);
                    }
                    await page.evaluate(() => { showPane('panel'); chooseNext(1); });
                    assert.deepStrictEqual(await page.evaluate(sticksOut), [], `a target at ${width} px`);
                    await page.evaluate(() => chooseObject(-1));
                    assert.deepStrictEqual(await page.evaluate(sticksOut), [], `nothing chosen at ${width} px`);
                    assert.strictEqual(await page.evaluate(() => window.broken), undefined);
                }, {viewport: {width, height: 700}});
            }
        };
    }
    return tests;
};
