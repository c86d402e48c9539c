// Tests of what shows the whole frame and the whole scene: the table, the switches, the time
// line and links. tools are the helpers of tests.js.

const assert = require('node:assert');

// The reported values of a frame's targets, in the order in which the page numbers them.
function listed(frame) {
    return frame.sensors.list.flatMap(({name}) => frame.targets.filter(one => one.sensor === name));
}

function leadingObject(target) {
    return target.contributors[0].object;
}

module.exports = ({stream, view, withPage, targetOnMap, clickMap, panelText, clock}) => {
    const intersection = stream('intersection');
    const busy = intersection.reduce((most, one) => one.targets.length > most.targets.length ? one : most);
    const atBusy = ['--frame', String(busy.frame)];
    const columnOf = (page, i) => page.locator(`#targets tbody td:nth-child(${i + 1})`).allInnerTexts();

    return {
        async 'the table has every target of the frame and sorts by every column'() {
            await withPage(view(intersection, ...atBusy), async page => {
                await page.click('[aria-controls=targets]');
                await page.setViewportSize({width: 1280, height: 1400});
                const values = {
                    1: one => one.range_m.toFixed(2), 2: one => (one.azimuth_rad * 180 / Math.PI).toFixed(1),
                    3: one => one.range_rate_mps.toFixed(2), 4: one => one.amplitude_db.toFixed(1),
                };
                for (const [i, value] of Object.entries(values)) {
                    const expected = listed(busy).map(value).map(Number).sort((a, b) => a - b);
                    await page.locator('#targets th button').nth(Number(i)).click();
                    assert.deepStrictEqual((await columnOf(page, Number(i))).map(Number), expected);
                    await page.locator('#targets th button').nth(Number(i)).click();
                    assert.deepStrictEqual((await columnOf(page, Number(i))).map(Number), expected.reverse());
                }
                await page.locator('#targets th button').nth(5).click();
                assert.deepStrictEqual(await columnOf(page, 5), listed(busy).map(leadingObject).sort());
            });
        },

        async 'the table finds targets by object, reflector, sensor and path'() {
            await withPage(view(intersection, ...atBusy), async page => {
                await page.keyboard.press('/');
                const {object, reflector} = busy.targets[0].contributors[0];
                for (const words of [object, `${reflector} left`, 'direct', 'nothing of that name']) {
                    await page.fill('#search', words);
                    const expected = listed(busy).filter(target => words.split(' ').every(word =>
                        target.sensor.includes(word) || target.contributors.some(part =>
                            [part.object, part.reflector, part.path].some(name => name.includes(word)))));
                    if (!words.includes(' of ')) {
                        assert.ok(expected.length > 0, words);
                    }
                    assert.match(await page.innerText('#found'), new RegExp(`^${expected.length} target`));
                }
                await page.keyboard.press('Escape');
                assert.match(await page.innerText('#found'), new RegExp(`^${busy.targets.length} target`));
            });
        },

        async 'the table is copied whole, in columns'() {
            await withPage(view(intersection, ...atBusy), async page => {
                await page.evaluate(() => {
                    window.addEventListener('copy', event => {
                        window.copied = event.clipboardData.getData('text/plain');
                    });
                });
                await page.focus('#map');
                await page.keyboard.press('y');
                const [headings, ...lines] = (await page.evaluate(() => window.copied)).trim().split('\n');
                assert.strictEqual(headings,
                    'sensor\ttarget\trange_m\tazimuth_deg\trange_rate_mps\tamplitude_db\tobject');
                assert.deepStrictEqual(lines.map(one => one.split('\t')[2]),
                    listed(busy).map(one => one.range_m.toFixed(2)));
                assert.deepStrictEqual(lines.map(one => one.split('\t')[6]), listed(busy).map(leadingObject));
            });
        },

        async 'rows choose targets, by mouse and by arrow keys'() {
            await withPage(view(intersection, ...atBusy), async page => {
                await page.click('[aria-controls=targets]');
                await page.locator('#targets tbody tr').nth(2).click();
                const chosen = () => page.evaluate(() => state.target - targetsOf(scansOf(state.frame).begin).begin);
                assert.strictEqual(await chosen(), 2);
                await page.keyboard.press('ArrowDown');
                assert.strictEqual(await chosen(), 3);
                await page.keyboard.press('ArrowUp');
                await page.keyboard.press('ArrowUp');
                assert.strictEqual(await chosen(), 1);
                assert.strictEqual(await page.locator('#targets tr.chosen td').nth(1).innerText(),
                    listed(busy)[1].range_m.toFixed(2));
                await page.locator('#targets tbody tr').nth(1).dblclick();
                assert.match(await panelText(page), /Target 2 of left/);
            });
        },

        async 'under the pointer a target says what it is'() {
            const target = busy.targets.find(one => one.sensor === 'left');
            await withPage(view(intersection, ...atBusy), async page => {
                await page.evaluate(() => { state.object = -1; fitView(); });
                await page.click('[aria-controls=targets]');
                const at = await targetOnMap(page, busy, target);
                const box = await page.locator('#map').boundingBox();
                await page.mouse.move(box.x + at.x, box.y + at.y);
                assert.ok((await page.innerText('#tip')).includes(`${target.range_m.toFixed(2)} m`));
                assert.strictEqual(await page.locator('#targets tr.hover').count(), 1);
                await page.mouse.move(box.x + 5, box.y + box.height - 5);
                assert.ok(await page.isHidden('#tip'));
            });
        },

        async 'a second click on stacked targets takes the next one'() {
            const frame = structuredClone(busy);
            frame.targets = frame.targets.filter(one => one.sensor === 'left');
            const [first, ...others] = frame.targets;
            others.slice(0, 2).forEach(one =>
                Object.assign(one, {range_m: first.range_m, azimuth_rad: first.azimuth_rad}));
            const stack = {...frame, sections: undefined, lost: undefined, counts: undefined, last: true};
            await withPage(view([stack]), async page => {
                await page.evaluate(() => { chooseObject(-1); fitView(); });
                const seen = [];
                for (let i = 0; i < 4; i++) {
                    await clickMap(page, await targetOnMap(page, frame, first));
                    const text = await panelText(page);
                    assert.match(text, /Target \d+ of left/);
                    seen.push(/Target (\d+)/.exec(text)[1]);
                }
                assert.strictEqual(new Set(seen.slice(0, 3)).size, 3, String(seen));
                assert.strictEqual(seen[3], seen[0]);
            });
        },

        async 'sensors, paths and classes are switched in the legend, by keys too'() {
            const ghosts = stream('ghosts');
            const frame = ghosts.find(one => one.targets.some(target => target.contributors[0].path !== 'direct') &&
                one.targets.some(target => target.contributors[0].path === 'direct'));
            const count = test => new RegExp(`^${frame.targets.filter(test).length} target`);
            await withPage(view(ghosts, '--frame', String(frame.frame)), async page => {
                await page.click('[aria-controls=targets]');
                await page.click('#switches summary');
                await page.uncheck('#switches >> text=direct');
                assert.match(await page.innerText('#found'), count(one => one.contributors[0].path !== 'direct'));
                await page.check('#switches >> text=direct');
                await page.keyboard.press('h');
                await page.keyboard.press('Space');
                const {name} = frame.sensors.list[0];
                assert.match(await page.innerText('#found'), count(one => one.sensor !== name));
                await page.keyboard.press('Space');
                const kind = frame.objects.find(one => one.id === frame.targets[0].contributors[0].object).class;
                const ofKind = new Set(frame.objects.filter(one => one.class === kind).map(one => one.id));
                await page.locator('#switches label', {hasText: new RegExp(`^${kind}$`)}).click();
                assert.match(await page.innerText('#found'), count(one => !ofKind.has(one.contributors[0].object)));
            });
        },

        async 'go to takes the number of a frame or a time, and refuses what is neither'() {
            await withPage(view(intersection), async page => {
                const go = async text => {
                    await page.keyboard.press('g');
                    await page.keyboard.type(text);
                    await page.keyboard.press('Enter');
                };
                await go('120');
                assert.match(await clock(page), /^frame 120 /);
                await go('2.4 s');
                assert.match(await clock(page), /2\.400 s/);
                await go('nowhere');
                assert.match(await clock(page), /2\.400 s/);
                assert.match(await page.evaluate(() => control('goto').validationMessage), /^A frame of this scene, or a time/);
                await page.keyboard.press('Escape');
                assert.strictEqual(await page.inputValue('#goto'), '');
            });
        },

        async 'in a loop the scene begins again'() {
            await withPage(view(intersection, '--frame', String(intersection.at(-1).frame - 2)), async page => {
                await page.keyboard.press('l');
                await page.keyboard.press('Space');
                await page.waitForFunction(() => state.playing && state.row < 5);
                await page.keyboard.press('Space');
            });
        },

        async 'Play runs through scenes of one frame, and keys step from scene to scene'() {
            const frames = [3, 50, 100, 150].map((at, i) =>
                ({...intersection[at], scene: `snapshot ${i}`, frame: 0, last: true}));
            await withPage(view(frames), async page => {
                await page.keyboard.press('PageDown');
                assert.strictEqual(await page.inputValue('#scene'), '1');
                await page.keyboard.press('PageUp');
                await page.selectOption('#pace', '5');
                await page.focus('#map');
                await page.keyboard.press('Space');
                await page.waitForFunction(() => state.scene === 3 && !state.playing);
            });
        },

        async 'the band over the slider is highest where most targets are'() {
            await withPage(view(intersection), async page => {
                assert.strictEqual(await page.innerText('#most'), `up to ${busy.targets.length} targets`);
                const [bars, most] = [await page.locator('#band').boundingBox(), await page.locator('#most').boundingBox()];
                assert.ok(most.x >= bars.x + bars.width, 'the number lies over the band');
                const poor = intersection.findIndex(one => one.targets.length < busy.targets.length / 3);
                const [tall, low] = await page.evaluate(rows => {
                    const {data, width, height} = bandContext.getImageData(0, 0, band.width, band.height);
                    return rows.map(row => {
                        const x = Math.round(bandPlace(row, sceneFrames[0].length, width));
                        return Array.from({length: height}, (_, y) => data[4 * (y * width + x) + 3])
                            .filter(alpha => alpha > 100).length;
                    });
                }, [intersection.indexOf(busy), poor]);
                assert.ok(tall >= 17, String(tall));
                assert.ok(low < tall / 2, String(low));
            });
        },

        async 'plots over time have every target of the chosen object, and reasons in the gaps'() {
            const object = leadingObject(busy.targets[0]);
            const has = frame => frame.targets.filter(target =>
                target.contributors.some(part => part.object === object));
            const lost = frame => frame.lost.filter(group => group.echoes.some(echo => echo.object === object));
            const gap = intersection.find(frame => has(frame).length === 0 && lost(frame).length > 0);
            await withPage(view(intersection), async page => {
                await page.evaluate(id => chooseObject(names.indexOf(id)), object);
                await page.click('[aria-controls=over-time]');
                const shown = await page.evaluate(() => series.points.map(({row, target}) =>
                    [row, column('target_range_m')[target].toFixed(2)].join()).sort());
                assert.deepStrictEqual(shown, intersection.flatMap((frame, row) =>
                    has(frame).map(one => [row, one.range_m.toFixed(2)].join())).sort());
                const box = await page.locator('#series').boundingBox();
                const x = await page.evaluate(row => timePlace(overTimePanel(
                    {width: overTimeCanvas.clientWidth, height: overTimeCanvas.clientHeight}, 0), row),
                intersection.indexOf(gap));
                await page.mouse.move(box.x + x, box.y + 40);
                const words = await page.innerText('#tip');
                assert.ok(lost(gap).some(group => words.includes(group.reason.replace(/_/g, ' '))), words);
                await page.mouse.click(box.x + x, box.y + 40);
                assert.match(await clock(page), new RegExp(`^frame ${gap.frame} `));
            });
        },

        async 'plots over time follow a reflector, and a sensor'() {
            const part = busy.targets.find(one => one.sensor === 'left').contributors[0];
            await withPage(view(intersection), async page => {
                await page.evaluate(({object, reflector}) =>
                    chooseReflector(reflector, names.indexOf(object)), part);
                await page.click('[aria-controls=over-time]');
                await page.selectOption('#plotted', 'left');
                const count = test => intersection.flatMap(one => one.targets)
                    .filter(one => one.sensor === 'left' && test(one)).length;
                assert.strictEqual(await page.evaluate(() => series.points.length),
                    count(one => one.contributors.some(other =>
                        other.object === part.object && other.reflector === part.reflector)));
                await page.evaluate(() => chooseObject(-1));
                assert.strictEqual(await page.evaluate(() => series.points.length), count(() => true));
            });
        },

        async 'a side plot grows over the map and goes back'() {
            await withPage(view(intersection), async page => {
                const width = async id => (await page.locator(id).boundingBox())?.width || 0;
                assert.ok(await width('#azimuths') < 250);
                await page.click('#large-azimuth');
                assert.ok(await width('#azimuths') > 800);
                await page.keyboard.press('m');
                assert.ok(await width('#speeds') > 800);
                await page.keyboard.press('Escape');
                assert.ok(await width('#speeds') < 250 && await width('#azimuths') < 250);
            });
        },

        async 'a link restores scene, frame, object and colour, and so does loading again'() {
            const other = intersection.map(frame => ({...frame, scene: 'second & last'}));
            const file = view([...intersection, ...other]);
            const object = leadingObject(busy.targets[0]);
            const link = '#' + new URLSearchParams({
                scene: 'second & last', frame: String(busy.frame), object, colour: 'path'});
            const look = page => page.evaluate(() => ({
                scene: sceneName(head.scenes[state.scene]), frame: frameNumber(state.frame),
                object: names[state.object], colour: state.colour, shown: document.getElementById('colour').value,
            }));
            const expected = {scene: 'second & last', frame: busy.frame, object, colour: 'path', shown: 'path'};
            await withPage(file, async page => {
                await page.evaluate(hash => { location.hash = hash; }, link);
                await page.waitForFunction(() => state.scene === 1);
                assert.deepStrictEqual(await look(page), expected);
                await page.keyboard.press('ArrowRight');
                await page.waitForFunction(frame => location.hash.includes(`frame=${frame}`), busy.frame + 1);
                await page.reload();
                assert.deepStrictEqual(await look(page), {...expected, frame: busy.frame + 1});
                await page.keyboard.press('Escape');
                await page.waitForFunction(() => location.hash.includes('object=&'));
                await page.reload();
                assert.strictEqual(await page.evaluate(() => state.object), -1);
            });
        },
    };
};
