// Tests of events, of links that hold the whole view, of zooming in the side plots and of streams without
// objects. Events are found here from the stream alone.

const assert = require('node:assert');
const {execFileSync} = require('node:child_process');
const path = require('node:path');

const root = path.join(__dirname, '..', '..');
const isGhost = target => target.contributors[0].path.includes('wall');
const isBody = target => ['direct', 'wheel', 'limb'].includes(target.contributors[0].path);
const leader = target => target.contributors[0].object;

const isRoadUser = (frame, id) => frame.objects.some(one => one.id === id && !['guardrail', 'post', 'wall'].includes(one.class));

// The objects that have at least this weight in a target, if they are several.
function mergedIn({contributors}, least) {
    const objects = [...new Set(contributors.map(part => part.object))].sort();
    const weightOf = object => contributors.filter(part => part.object === object).reduce((sum, {weight}) => sum + weight, 0);
    const heavy = objects.filter(object => weightOf(object) >= least);
    return heavy.length > 1 ? heavy : [];
}

// What begins, by kind: the row of the frame for each key that a sensor's scan has and its scan before had not.
// Of merges only those of at least this weight, of one object and another of which these are true.
function eventsOf(frames, least = 0, of = [() => true, () => true]) {
    const rows = {ghost: [], merge: [], split: [], miss: [], false_alarm: []};
    const before = new Map();
    frames.forEach((frame, row) => frame.sensors.list.filter(one => one.measured).forEach(({name}) => {
        const targets = frame.targets.filter(one => one.sensor === name);
        const bodies = targets.filter(isBody).map(leader).filter(id => isRoadUser(frame, id));
        const now = {
            ghost: targets.filter(isGhost).map(leader),
            merge: targets.filter(one => mergedIn(one, least).some(id => of[0](id, frame) &&
                mergedIn(one, least).some(other => other !== id && of[1](other, frame))))
                .map(one => mergedIn(one, 0).join('|')),
            split: bodies.filter((one, i) => bodies.indexOf(one) < i),
            seen: bodies,
        };
        const then = before.get(name) || {ghost: [], merge: [], split: [], seen: []};
        for (const kind of ['ghost', 'merge', 'split']) {
            new Set(now[kind].filter(key => !then[kind].includes(key))).forEach(() => rows[kind].push(row));
        }
        new Set(then.seen.filter(id => !now.seen.includes(id) && isRoadUser(frame, id)))
            .forEach(() => rows.miss.push(row));
        targets.filter(one => one.contributors[0].path === 'false_alarm').forEach(() => rows.false_alarm.push(row));
        before.set(name, now);
    }));
    return Object.fromEntries(Object.entries(rows).filter(([, list]) => list.length > 0));
}

module.exports = ({stream, view, withPage, targetOnMap, panelText, clock}) => {
    const chain = words => execFileSync('glint', ['-c', words], {maxBuffer: 1 << 28, cwd: root, stdio: ['ignore', 'pipe', 'ignore']})
        .toString().trim().split('\n').map(line => JSON.parse(line));
    const recorded = () => chain('glint-traffic data/trajectories/highway.csv --ego 2 | glint-extract | ' +
        'glint-ideal --sensors lrr77-full --sections account | glint-sensor | glint-noise');

    return {
        async 'lanes have a line for each event of the stream, and keys and buttons go from one to the next'() {
            for (const name of ['ghosts', 'intersection', 'clutter', 'smear']) {
                const frames = stream(name);
                const expected = eventsOf(frames);
                assert.ok(Object.keys(expected).length >= 2, name);
                await withPage(view(frames), async page => {
                    const found = await page.evaluate(() => Object.fromEntries(Object.entries(eventsOfScene())
                        .map(([kind, list]) => [kind, list.map(one => one.row)])));
                    assert.deepStrictEqual(found, expected, name);
                    await page.click('[aria-controls=over-time]');
                    const titles = await page.locator('#lanes button').allInnerTexts();
                    assert.deepStrictEqual(titles.map(one => Number(/\d+$/.exec(one))).sort(),
                        Object.values(expected).map(list => list.length).sort());
                    await page.keyboard.press('Home');
                    const every = Object.values(expected).flat().sort((a, b) => a - b).filter(row => row > 0);
                    for (const row of every.slice(0, 3)) {
                        await page.keyboard.press('.');
                        assert.strictEqual(await page.evaluate(() => state.row), row);
                    }
                    await page.keyboard.press(',');
                    assert.strictEqual(await page.evaluate(() => state.row), every[1]);
                    await page.click('#next-event');
                    assert.strictEqual(await page.evaluate(() => state.row), every[2]);
                    await page.click('#last-event');
                    assert.strictEqual(await page.evaluate(() => state.row), every[1]);
                });
            }
        },

        async 'merges are filtered by their objects and weights, and the link holds the filter'() {
            const frames = stream('intersection');
            const merged = frames.flatMap(({targets}) => targets.map(one => mergedIn(one, 0)).filter(list => list.length > 1));
            const [one, other] = merged[0];
            const all = eventsOf(frames).merge.length;
            const isOf = choice => (id, frame) => choice === 'road user' ? isRoadUser(frame, id) : ['', id].includes(choice);
            const titles = page => page.innerText('#lanes');
            let link;
            await withPage(view(frames), async page => {
                await page.click('[aria-controls=over-time]');
                const listed = await page.locator('#merge-one option').allInnerTexts();
                assert.deepStrictEqual(listed.slice(2).sort(), [...new Set(merged.flat())].sort());
                const weights = (await page.locator('#merge-weight option').evaluateAll(list => list.map(({value}) => value)));
                const counts = new Set();
                for (const [of, weight] of [[[], '0'], ...weights.map(value => [[], value]), [[one, one], '0'], [['road user'], '0'],
                    [['road user', 'road user'], '0'], [[one], '0'], [[one, other], '0'], [[other, one], '0.25']]) {
                    const [first = '', second = ''] = of;
                    await page.selectOption('#merge-one', first);
                    await page.selectOption('#merge-other', second);
                    await page.selectOption('#merge-weight', weight);
                    const {merge = []} = eventsOf(frames, Number(weight), [isOf(first), isOf(second)]);
                    counts.add(merge.length);
                    const told = merge.length > 0 ? `merges: ${merge.length}` : 'none: ghosts, merges, false alarms';
                    assert.ok((await titles(page)).split('\n').includes(told), `${of} ${weight}: ${await titles(page)}`);
                }
                assert.ok(counts.size > 1 && Math.max(...counts) === all, [...counts].join());
                await page.selectOption('#merge-weight', '0');
                await page.click('#lanes [data-kind=merge]');
                await page.click('[aria-controls=panel]');
                const text = await panelText(page);
                assert.ok(text.includes(`of ${one}`) && text.includes(`of ${other}`), text);
                await page.waitForFunction(() => location.hash.includes('merge-one='));
                await page.waitForTimeout(400);
                link = await page.evaluate(() => location.hash);
            });
            await withPage(view(frames), async page => {
                await page.evaluate(hash => { location.hash = hash; }, link);
                await page.click('[aria-controls=over-time]');
                await page.waitForFunction(() => control('merge-one').value !== '');
                const {merge} = eventsOf(frames, 0, [isOf(one), isOf(other)]);
                assert.match(await titles(page), new RegExp(`merges: ${merge.length}\\b`));
            });
        },

        async 'a button and a key copy the link to the view as it is'() {
            for (const act of [page => page.click('#share'), page => page.keyboard.press('k')]) {
                await withPage(view(stream('side')), async page => {
                    await page.evaluate(() => window.addEventListener('copy', event => {
                        window.copied = event.clipboardData.getData('text/plain');
                    }));
                    await page.keyboard.press('n');
                    await page.selectOption('#colour', 'path');
                    const target = await page.evaluate(() => targetText());
                    await act(page);
                    const copied = new URL(await page.evaluate(() => window.copied));
                    const parts = new URLSearchParams(copied.hash.slice(1));
                    assert.strictEqual(copied.protocol, 'file:');
                    assert.strictEqual(parts.get('target'), target);
                    assert.strictEqual(parts.get('colour'), 'path');
                    assert.strictEqual(await page.innerText('#share'), '✓');
                    await page.waitForFunction(() => control('share').textContent === '↗');
                });
            }
        },

        async 'on paper the page is light and shows map, legend and detail, without controls, from any window'() {
            await withPage(view(stream('corner')), async page => {
                await page.setViewportSize({width: 700, height: 900});
                await page.evaluate(() => setTheme(true));
                await page.evaluate(() => window.dispatchEvent(new Event('beforeprint')));
                await page.emulateMedia({media: 'print'});
                assert.strictEqual(await page.evaluate(() => getComputedStyle(document.body).backgroundColor), 'rgb(255, 255, 255)');
                for (const id of ['map', 'legend', 'panel', 'sentence']) {
                    assert.ok(await page.isVisible('#' + id), id);
                }
                for (const one of ['header', 'footer', '#zoom', '#panes', '#legend input']) {
                    assert.ok(await page.locator(one).first().isHidden(), one);
                }
                const [map, legend, panel] = await Promise.all(['#map', '#legend', '#panel'].map(id => page.locator(id).boundingBox()));
                assert.ok(legend.y >= map.y + map.height - 1 && legend.height > 60, 'the unfolded legend lies below the map');
                assert.ok(panel.x >= map.x + map.width - 1, 'the detail lies beside the map');
                await page.emulateMedia({media: 'screen'});
                await page.evaluate(() => window.dispatchEvent(new Event('afterprint')));
                assert.ok(await page.evaluate(() => isDark()));
            });
        },

        async 'each event of a frame is reached, by keys, by the name of its lane and by its line'() {
            const frames = stream('ghosts');
            const {false_alarm: rows} = eventsOf(frames);
            const crowded = rows.find((row, i) => rows[i + 1] === row);
            const there = rows.filter(row => row === crowded).length;
            const isAlarm = target => target.contributors[0].path === 'false_alarm';
            await withPage(view(frames), async page => {
                const target = () => page.evaluate(() => state.target);
                await page.click('[aria-controls=over-time]');
                const reached = {title: new Set(), back: new Set(), line: new Set()};
                for (let i = 0; i < rows.length; i++) {
                    await page.click('#lanes [data-kind=false_alarm]');
                    reached.title.add(await target());
                }
                assert.strictEqual(reached.title.size, frames.flatMap(frame => frame.targets.filter(isAlarm)).length);
                for (let i = 0; i < rows.length; i++) {
                    reached.back.add(await target());
                    await page.keyboard.press(',');
                }
                assert.deepStrictEqual([...reached.back].sort(), [...reached.title].sort());
                const x = await page.evaluate(at => timePlace(laneSpan(control('series')), at), crowded);
                for (let i = 0; i < there; i++) {
                    await page.locator('#lanes [data-kind=false_alarm] + canvas').click({position: {x, y: 5}});
                    assert.strictEqual(await page.evaluate(() => state.row), crowded);
                    reached.line.add(await target());
                }
                assert.strictEqual(reached.line.size, there);
            });
        },

        async 'a click on a lane goes to the event there'() {
            const frames = stream('ghosts');
            const {ghost, false_alarm: alarms} = eventsOf(frames);
            await withPage(view(frames), async page => {
                await page.click('[aria-controls=over-time]');
                const alone = list => list.filter(row => list.indexOf(row) === list.lastIndexOf(row));
                for (const [kind, row, words] of [['ghost', alone(ghost)[2], /, a ghost/],
                    ['false_alarm', alone(alarms)[4], /, a false alarm/]]) {
                    const x = await page.evaluate(at => timePlace(laneSpan(control('series')), at), row);
                    await page.locator(`#lanes [data-kind=${kind}] + canvas`).click({position: {x, y: 5}});
                    assert.strictEqual(await page.evaluate(() => state.row), row);
                    await page.keyboard.press('.');
                    const list = kind === 'ghost' ? ghost : alarms;
                    assert.strictEqual(await page.evaluate(() => state.row), list[list.indexOf(row) + 1]);
                    await page.click('[aria-controls=panel]');
                    assert.match(await panelText(page), words);
                    await page.click('[aria-controls=over-time]');
                }
            });
        },

        async 'from opening a recording to its first ghost there are at most two clicks'() {
            for (const frames of [recorded(), stream('ghosts'), stream('3gpp')]) {
                const first = frames.find(frame => frame.targets.some(isGhost));
                await withPage(view(frames), async page => {
                    await page.evaluate(() => {
                        window.clicks = 0;
                        document.addEventListener('click', () => { window.clicks++; }, true);
                    });
                    await page.click('[aria-controls=over-time]');
                    await page.click('#lanes [data-kind=ghost]');
                    assert.ok(await page.evaluate(() => window.clicks) <= 2);
                    assert.match(await clock(page), new RegExp(`^frame ${first.frame} `));
                    assert.ok(await page.evaluate(() => kindOf(state.target) === 'ghost' && onScreen(toScreen(targetPlace(
                        scanOfTarget(state.frame, state.target), state.target)), 0)), 'the ghost is chosen and in view');
                });
            }
        },

        async 'the wheel zooms a side plot where it points, a drag moves it, a double click shows everything'() {
            const frames = stream('smear');
            await withPage(view(frames), async page => {
                await page.evaluate(() => draw());
                for (const kind of ['azimuth', 'rate']) {
                    const spot = await page.evaluate(one => plots[one].hits[0], kind);
                    const box = await page.locator(kind === 'azimuth' ? '#azimuths' : '#speeds').boundingBox();
                    const axes = () => page.evaluate(one => plotAxes(one), kind);
                    const place = target => page.evaluate(([one, wanted]) => {
                        draw();
                        return plots[one].hits.find(hit => hit.target === wanted);
                    }, [kind, target]);
                    const whole = await axes();
                    await page.mouse.move(box.x + spot.x, box.y + spot.y);
                    await page.mouse.wheel(0, -1000);
                    await page.waitForFunction(one => plots[one].axes, kind);
                    const near = await axes();
                    const ratio = (whole.right - whole.left) / (near.right - near.left);
                    assert.ok(Math.abs(ratio - Math.exp(1.5)) < 0.01, String(ratio));
                    const after = await place(spot.target);
                    const off = Math.exp(1.5) - 1; // px: a place in the window is whole, that of the target is not
                    assert.ok(Math.hypot(after.x - spot.x, after.y - spot.y) < 1.5 * off, JSON.stringify([spot, after]));
                    await page.mouse.down();
                    await page.mouse.move(box.x + spot.x + 6, box.y + spot.y - 9);
                    await page.mouse.up();
                    const moved = await place(spot.target);
                    assert.ok(Math.hypot(moved.x - after.x - 6, moved.y - after.y + 9) < 1.5, JSON.stringify([after, moved]));
                    await page.mouse.dblclick(box.x + 60, box.y + 60);
                    assert.deepStrictEqual(await axes(), whole);
                }
            });
        },

        async 'a resolution cell is as wide as the radar has it, or not drawn'() {
            for (const name of ['highway', 'intersection', 'perfect']) {
                await withPage(view(stream(name)), async page => {
                    const boxes = () => page.evaluate(() => {
                        const drawing = plots.rate.canvas.getContext('2d');
                        const found = [];
                        drawing.strokeRect = (x, y, width, height) => found.push({width, height});
                        draw();
                        delete drawing.strokeRect;
                        const axes = plotAxes('rate');
                        const {clientWidth, clientHeight} = plots.rate.canvas;
                        return found.map(({width, height}) => ({
                            rate: width / (clientWidth - plotMargin.left - plotMargin.right) * (axes.right - axes.left),
                            range: height / (clientHeight - plotMargin.top - plotMargin.bottom) * (axes.top - axes.bottom)}));
                    });
                    const [cell] = stream(name)[0].sensors.list; // these suites merge what is within the stated cell
                    const check = list => list.forEach(({rate, range}) => {
                        assert.ok(Math.abs(rate / cell.cell_range_rate_mps - 1) < 0.01, `${name}: ${rate} m/s`);
                        assert.ok(Math.abs(range / cell.cell_range_m - 1) < 0.01, `${name}: ${range} m`);
                    });
                    check(await boxes());
                    await page.evaluate(() => {
                        const {x, y} = plots.rate.hits[0];
                        zoomPlot('rate', 200, x, y);
                    });
                    const near = await boxes();
                    assert.ok(near.length > 0, name);
                    check(near);
                });
            }
        },

        async 'a link holds the whole view'() {
            const frames = stream('ghosts');
            const file = view(frames);
            const look = page => page.evaluate(() => JSON.parse(JSON.stringify({
                row: state.row, object: state.object, target: state.target, pane: state.pane, large: state.large,
                colour: state.colour, effect: state.effect, rates: state.rates, up: state.up, follow: state.follow,
                trail: state.trail, event: state.event, plotted: control('plotted').value,
                shown: ['colour', 'effect', 'rates', 'up'].map(id => control(id).value),
                off: Object.values(switchedOff).map(set => [...set]),
                camera: [camera.x, camera.y, camera.scale].map(one => Number(one.toPrecision(4))),
                axes: Object.values(plots).map(({axes}) => axes && Object.values(axes).map(one => Number(one.toPrecision(4)))),
            })));
            let link;
            let before;
            await withPage(file, async page => {
                await page.keyboard.press('n');
                await page.selectOption('#rates', 'compensated');
                await page.selectOption('#colour', 'path');
                await page.selectOption('#effect', {label: 'merging'});
                await page.keyboard.press('t');
                await page.keyboard.press('f');
                await page.keyboard.press('x');
                await page.keyboard.press('+');
                await page.click('#switches summary');
                await page.uncheck('#switches >> text=false alarm');
                await page.click('[aria-controls=over-time]');
                await page.selectOption('#plotted', 'front');
                await page.click('#lanes [data-kind=ghost]');
                await page.evaluate(() => zoomPlot('azimuth', 3, 60, 70));
                await page.evaluate(() => enlargePlot('rate'));
                await page.evaluate(() => zoomPlot('rate', 2, 300, 200));
                await page.evaluate(() => panBy(40, -25));
                await page.waitForFunction(() => location.hash.includes('rate='));
                await page.waitForTimeout(400);
                before = await look(page);
                link = await page.evaluate(() => location.hash);
            });
            assert.ok(before.target >= 0 && before.off[1].length === 1 && before.axes.every(Boolean));
            for (const way of ['opened', 'followed']) {
                await withPage(file, async page => {
                    await page.evaluate(hash => { location.hash = hash; }, link);
                    if (way === 'opened') {
                        await page.reload();
                    }
                    await page.waitForFunction(() => state.large === 'rate');
                    assert.deepStrictEqual(await look(page), before, way);
                });
            }
            await withPage(file, async page => {
                await page.evaluate(() => { location.hash = '#scene=none&target=900%20front&map=a,b,0&rate=1&pane=no&off=x'; });
                await page.waitForTimeout(100);
                assert.strictEqual(await page.evaluate(() => state.target), -1);
                assert.strictEqual(await page.evaluate(() => state.pane), 'panel');
            });
        },

        async 'a stream without objects opens: its targets lie around the ego'() {
            const words = sections => 'glint-traffic intersection | glint-extract | glint-ideal --sensors srr24-pair ' +
                `--sections ${sections} | glint-sensor | glint-noise`;
            for (const sections of ['none', 'account,-objects']) {
                const frames = chain(words(sections));
                assert.ok(frames.every(frame => !frame.objects));
                const most = frames.reduce((best, one) => one.targets.length > best.targets.length ? one : best);
                await withPage(view(frames, '--frame', String(most.frame)), async page => {
                    assert.match(await page.innerText('#notice'), /has no objects/);
                    assert.match(await page.innerText('#sentence'), new RegExp(`: ${most.targets.length} targets`));
                    await page.evaluate(() => { chooseObject(-1); fitTargets(); });
                    const sensor = most.sensors.list[0].name;
                    for (const target of most.targets.filter(one => one.sensor === sensor)) {
                        const at = await targetOnMap(page, most, target);
                        assert.ok(await page.evaluate(place => nearest(targetHits(), place, 2) !== null, at));
                    }
                    await page.keyboard.press('v');
                    await page.keyboard.press('n');
                    assert.match(await panelText(page), /over ground\s+not known/);
                    for (const pane of ['targets', 'over-time', 'panel']) {
                        await page.evaluate(id => { showPane(id); draw(); }, pane);
                    }
                });
            }
        },
    };
};
