// Tests of what the page says of echoes: where they were, what a target is without noise, which marks
// they have, and how many are in no target. Places are computed here from the stream alone.

const assert = require('node:assert');
const {execFileSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

const root = path.join(__dirname, '..', '..');
const pipelines = fs.readdirSync(path.join(root, 'pipelines')).filter(name => name.endsWith('.sh'))
    .map(name => name.slice(0, -3)).filter(name => !['mud', 'table'].includes(name));

// A body some time before, in many small steps at constant speed and turn rate.
function before(body, age) {
    const steps = 200;
    let {x_m: x, y_m: y, yaw_rad: yaw, vx_mps: vx, vy_mps: vy} = body;
    const turn = -(body.yaw_rate_radps || 0) * age / steps;
    for (let i = 0; i < steps; i++) {
        [vx, vy] = [vx * Math.cos(turn) - vy * Math.sin(turn), vx * Math.sin(turn) + vy * Math.cos(turn)];
        x -= vx * age / steps;
        y -= vy * age / steps;
        yaw += turn;
    }
    return {x, y, yaw};
}

// Where a sensor measured something, in the axes of the ego at the frame's time.
function placeOf(frame, sensorName, range, azimuth) {
    const sensor = frame.sensors.list.find(one => one.name === sensorName);
    const ego = frame.objects.find(one => one.id === frame.ego);
    const then = before(ego, sensor.age_s || 0);
    const angle = then.yaw + sensor.mount_yaw_rad + azimuth;
    const x = then.x + sensor.mount_x_m * Math.cos(then.yaw) - sensor.mount_y_m * Math.sin(then.yaw) +
        range * Math.cos(angle) - ego.x_m;
    const y = then.y + sensor.mount_x_m * Math.sin(then.yaw) + sensor.mount_y_m * Math.cos(then.yaw) +
        range * Math.sin(angle) - ego.y_m;
    return {
        x: x * Math.cos(ego.yaw_rad) + y * Math.sin(ego.yaw_rad),
        y: y * Math.cos(ego.yaw_rad) - x * Math.sin(ego.yaw_rad),
    };
}

const keyOf = (sensor, one) =>
    [sensor, one.object, one.reflector, one.path, one.mirror || '', one.number || 0].join('|');

// All echoes that a frame names: [key, place] of contributors of listed objects and of losses.
function contributorsIn(frame) {
    const ids = new Set(frame.objects.map(one => one.id));
    return frame.targets.flatMap(target => target.contributors.filter(one => ids.has(one.object))
        .map(one => [keyOf(target.sensor, one), placeOf(frame, target.sensor, one.range_m, one.azimuth_rad)]));
}

function lossesIn(frame) {
    return (frame.lost || []).flatMap(group => group.echoes.map(one =>
        [keyOf(group.sensor, one), placeOf(frame, group.sensor, one.range_m || 0, one.azimuth_rad || 0)]));
}

function someOf(frames) {
    return frames.filter((_, i) => i % Math.ceil(frames.length / 7) === 0);
}

// Goes to a frame with nothing chosen, and notes every circle and word that is drawn.
function showFrame(page, frame) {
    return page.evaluate(([scene, number]) => {
        const at = head.scenes.findIndex((one, i) => names[one.name] === scene &&
            sceneFrames[i].some(row => frameNumber(row) === number));
        setScene(at, {row: sceneFrames[at].findIndex(row => frameNumber(row) === number), object: -1});
        if (!window.noted) {
            window.noted = {circles: [], words: []};
            const {arc, fillText} = CanvasRenderingContext2D.prototype;
            pen.arc = (x, y, radius, ...rest) => {
                window.noted.circles.push({x, y, radius});
                arc.call(pen, x, y, radius, ...rest);
            };
            pen.fillText = (text, ...rest) => {
                window.noted.words.push(text);
                fillText.call(pen, text, ...rest);
            };
        }
    }, [frame.scene, frame.frame]);
}

// What is drawn now: circles in the ego's axes, and words.
function drawnNow(page) {
    return page.evaluate(() => {
        window.noted.circles = [];
        window.noted.words = [];
        draw();
        return {words: window.noted.words, scale: camera.scale,
            circles: window.noted.circles.map(({x, y, radius}) => ({...screenToLocal(x, y), radius}))};
    });
}

const apart = (a, b) => Math.hypot(a.x - b.x, a.y - b.y);

module.exports = ({stream, view, withPage, panelText}) => {
    const streams = new Map();
    const streamOf = name => streams.get(name) || streams.set(name, stream(name)).get(name);
    const withMany = frames => frames.reduce((most, one) => one.targets.length > most.targets.length ? one : most);

    // The first loss of a later stage whose object has no more losses than the panel has rows for.
    const shownLoss = frame => {
        const echoes = frame.lost.flatMap(group => group.echoes);
        return frame.lost.filter(group => group.stage !== 'ideal').flatMap(group => group.echoes)
            .find(echo => echoes.filter(other => other.object === echo.object).length <= 40);
    };

    return {
        async 'in every pipeline every contributor and every loss has the place that the stream gives it'() {
            for (const name of pipelines) {
                const frames = streamOf(name);
                await withPage(view(frames), async page => {
                    for (const frame of someOf(frames)) {
                        await showFrame(page, frame);
                        const found = new Map(await page.evaluate(() => {
                            const all = [];
                            const add = (scan, object, one, place) => all.push([[sensorOf(scan).name, names[object],
                                names[one.reflector], head.paths[one.path], one.mirror > 0 ? names[one.mirror - 1] : '',
                                one.number].join('|'), place && toLocal(place)]);
                            const {begin, end} = scansOf(state.frame);
                            for (let scan = begin; scan < end; scan++) {
                                eachContributor(scan, i => add(scan, column('contributor_object')[i],
                                    {...echoOfContributor(i), reflector: column('contributor_reflector')[i]},
                                    contributorPlace(scan, i)));
                                eachFate(scan, object => lossesOf(scan, object).forEach(loss =>
                                    add(scan, object, loss, lossPlace(scan, loss))));
                            }
                            return all;
                        }));
                        for (const [key, place] of contributorsIn(frame).concat(lossesIn(frame))) {
                            assert.ok(found.get(key), `${name}, frame ${frame.frame}: ${key} has no place`);
                            assert.ok(apart(found.get(key), place) < 0.06,
                                `${name}, frame ${frame.frame}: ${key} is ${apart(found.get(key), place)} m off`);
                        }
                    }
                });
            }
        },

        async 'contributors are drawn, and a clicked loss has a ring within 10 px of it'() {
            for (const name of ['smear', '3gpp', 'ghosts', 'wheels-and-limbs', 'intersection']) {
                const frames = streamOf(name);
                const frame = withMany(frames.filter(shownLoss));
                await withPage(view(frames), async page => {
                    await showFrame(page, frame);
                    const [[, middle]] = contributorsIn(frame);
                    await page.evaluate(at => Object.assign(camera, at, {scale: 20}), middle);
                    const {circles, scale} = await drawnNow(page);
                    const seen = contributorsIn(frame).filter(([, at]) => apart(at, middle) * scale < 250);
                    for (const [key, place] of seen) {
                        assert.ok(circles.some(one => apart(one, place) * scale < 2), `${name}: ${key}`);
                    }
                    const echo = shownLoss(frame);
                    await page.evaluate(id => chooseObject(names.indexOf(id)), echo.object);
                    const row = page.locator('#panel .row.lost', {hasText: echo.reflector}).first();
                    await row.click();
                    const after = await drawnNow(page);
                    const rings = after.circles.filter(one => one.radius === 8);
                    const losses = lossesIn(frame).filter(([key]) => key.includes(`|${echo.object}|${echo.reflector}|`));
                    assert.ok(rings.length > 0 && rings.some(ring => losses.some(([, at]) =>
                        apart(ring, at) * after.scale < 10)), `${name}: ${echo.reflector}`);
                });
            }
        },

        async 'the level without noise is what glint-noise-none reports'() {
            for (const name of ['coherence', 'intersection', 'clutter']) {
                const text = fs.readFileSync(path.join(root, 'pipelines', name + '.sh'), 'utf8')
                    .replace(/\| glint-noise\s*$/, '| glint-noise-none');
                const without = execFileSync('glint', ['-c', text], {maxBuffer: 1 << 28, cwd: root}).toString()
                    .trim().split('\n').map(line => JSON.parse(line));
                const frames = streamOf(name);
                const labels = target => target.contributors.map(one => keyOf(target.sensor, one)).join();
                await withPage(view(frames), async page => {
                    let checked = 0;
                    for (const frame of someOf(frames)) {
                        await showFrame(page, frame);
                        const others = new Map(without[frames.indexOf(frame)].targets.map(one => [labels(one), one]));
                        const listed = frame.sensors.list.flatMap(({name: sensor}) =>
                            frame.targets.filter(one => one.sensor === sensor));
                        for (const [i, target] of listed.entries()) {
                            const other = others.get(labels(target));
                            if (!other) {
                                continue; // a false alarm
                            }
                            await page.evaluate(number =>
                                chooseTarget(targetsOf(scansOf(state.frame).begin).begin + number), i);
                            const row = await page.locator('table.values tr', {hasText: 'amplitude'}).innerText();
                            const [, reported, level] = /([-\d.]+) dB\s+([-\d.]+) dB/.exec(row).map(Number);
                            assert.ok(Math.abs(level - other.amplitude_db) <= 0.01, `${name}: ${row}, ${other.amplitude_db}`);
                            assert.ok(Math.abs(reported - target.amplitude_db) <= 0.01);
                            checked++;
                        }
                    }
                    assert.ok(checked >= 5, `${name}: ${checked}`);
                    assert.doesNotMatch(await panelText(page), /at most/);
                });
            }
        },

        async 'a share reads as none or all only if it is'() {
            const text = fs.readFileSync(path.join(root, 'pipelines', 'ambiguity.sh'), 'utf8');
            const [frame] = execFileSync('glint', ['-c', text], {maxBuffer: 1 << 28, cwd: root}).toString().trim()
                .split('\n').map(line => JSON.parse(line)).filter(one => one.targets.length > 0);
            Object.assign(frame, {sections: [], lost: [], counts: []});
            frame.targets[0].contributors = [{...frame.targets[0].contributors[0], weight: 0.996},
                {...frame.targets[0].contributors[0], number: 1, path: 'wheel', weight: 0.004}];
            await withPage(view([frame]), async page => {
                const told = await page.evaluate(() => [0, 1e-9, 0.0004, 0.004, 0.006, 0.5, 0.99, 0.996, 1 - 1e-9, 1].map(
                    share => percent(share)));
                assert.deepStrictEqual(told, ['0 %', 'under 0.001 %', '0.04 %', '0.4 %', '1 %', '50 %', '99 %', '99.6 %',
                    '100 %', '100 %']);
                await page.evaluate(() => chooseObject(objectOfTarget(targetsOf(scansOf(state.frame).begin).begin)));
                const rows = await page.locator('#panel .row:not(.lost) .what').allInnerTexts();
                assert.ok(rows.some(row => row.includes('99.6 %') && row.includes('0.4 %')), rows.join('; '));
            });
        },

        async 'the quality of a target is told where the stream has it'() {
            const text = fs.readFileSync(path.join(root, 'pipelines', 'ambiguity.sh'), 'utf8')
                .replace('--sections account', '--sections account,quality');
            const frames = execFileSync('glint', ['-c', text], {maxBuffer: 1 << 28, cwd: root}).toString()
                .trim().split('\n').map(line => JSON.parse(line));
            const isFolded = target => target.quality.ambiguity_number !== 0;
            const frame = frames.find(one => one.targets.some(isFolded));
            const chosen = number => chooseTarget(targetsOf(scansOf(state.frame).begin).begin + number);
            await withPage(view(frames), async page => {
                await showFrame(page, frame);
                for (const [number, {quality}] of frame.targets.entries()) {
                    await page.evaluate(chosen, number);
                    const rows = await page.locator('table#quality tr').allInnerTexts();
                    const shows = (name, value, unit, digits) => assert.ok(rows.includes(
                        `${name}\t${Math.fround(value).toFixed(digits).replace(/^-(0\.0*)$/, '$1')}${unit}`), `${name}: ${value}: ${rows.join('; ')}`);
                    shows('signal over noise', quality.snr_db, ' dB', 1);
                    shows('cross section', quality.rcs_dbsm, ' dBsm', 1);
                    shows('deviation of range', quality.range_sd_m, ' m', 3);
                    shows('… of azimuth', Math.fround(quality.azimuth_sd_rad) * 180 / Math.PI, '°', 2);
                    shows('… of range rate', quality.range_rate_sd_mps, ' m/s', 3);
                    shows('exists with', 100 * Math.fround(quality.existence), ' %', 1);
                    const place = [quality.x_rear_axle_m, quality.y_rear_axle_m].map(one => Math.fround(one).toFixed(2)).join(', ');
                    assert.ok(rows.includes(`from the rear axle\t${place} m`), rows.join('; '));
                    const folds = `${quality.ambiguity_number} times ${Math.fround(quality.range_rate_interval_mps).toFixed(2)} m/s`;
                    assert.ok(rows.includes(`label: true rate is off by\t${folds}`), rows.join('; '));
                }
            });
            await withPage(view(streamOf('ambiguity')), async page => {
                await showFrame(page, frame);
                await page.evaluate(chosen, 0);
                assert.strictEqual(await page.locator('table#quality').count(), 0);
            });
        },

        async 'false alarms, clutter, ghosts and interference have marks and legend lines of their own'() {
            for (const [name, words] of [['false-alarms', /false alarm: nothing but noise/],
                ['clutter', /clutter: an echo of the ground/], ['ghosts', /ghost: seen by way of a mirror/],
                ['interference', /disturbed by other radars/]]) {
                await withPage(view(streamOf(name)), async page => {
                    assert.match(await page.innerText('#legend'), words);
                });
            }
            await withPage(view(streamOf('intersection')), async page => {
                assert.doesNotMatch(await page.innerText('#legend'), /false alarm|clutter|ghost|disturbed|folded|when measured/);
            });
            const kinds = {clutter: 'clutter', false_alarm: 'false_alarm', direct: 'body', wheel: 'body', limb: 'body'};
            for (const name of ['clutter', 'ghosts']) {
                const frame = withMany(streamOf(name));
                await withPage(view(streamOf(name)), async page => {
                    await showFrame(page, frame);
                    const shown = await page.evaluate(() => {
                        const all = [];
                        eachTarget(state.frame, (scan, target) => all.push(kindOf(target)));
                        return all;
                    });
                    assert.deepStrictEqual(shown, frame.targets.map(one => kinds[one.contributors[0].path] || 'ghost'));
                });
            }
        },

        async 'strips beside the road are drawn where they are, as wide as they are'() {
            const frame = streamOf('roadside')[0];
            const band = {kind: 'vegetation', from_x_m: -50, from_y_m: -20, to_x_m: 150, to_y_m: -20, width_m: 8};
            // The colours of the map at these distances to the left of y = -20.
            const coloursOf = async strips => {
                let colours;
                await withPage(view([{...frame, roadside: strips}]), async page => {
                    colours = await page.evaluate(() => {
                        Object.assign(camera, {x: 0, y: -20, scale: 8});
                        drawMap();
                        const {data} = pen.getImageData(0, 0, canvas.width, canvas.height);
                        return [-4.7, -3.3, 1.3, 3.3, 4.7].map(left => {
                            const at = toScreen({x: 3.3, y: -20 + left});
                            const ratio = window.devicePixelRatio || 1;
                            const first = 4 * (Math.round(at.y * ratio) * canvas.width + Math.round(at.x * ratio));
                            return data.slice(first, first + 4).join();
                        });
                    });
                });
                return colours;
            };
            const bare = (await coloursOf(undefined))[0], colours = await coloursOf([band]);
            assert.deepStrictEqual(colours.map(colour => colour === bare), [true, false, false, false, true]);
        },

        async 'what lies on the ground is in the legend, drawn as on the map, even if the page knows nothing of its kind'() {
            const line = {from_x_m: 20, from_y_m: -6, to_x_m: 20, to_y_m: 6};
            const strips = ['rail', 'poles'].map(kind => ({...line, kind}));
            await withPage(view([{...streamOf('roadside')[0], roadside: strips}]), async page => {
                assert.match(await page.innerText('#legend'), /rail\s+poles/);
                const dashes = await page.evaluate(stop => {
                    head.scenes[0].ground.push(stop);
                    showLegend();
                    pen = new SvgPen();
                    drawGround();
                    const {text} = pen;
                    pen = canvasPen;
                    return text.trim().split('\n').map(one => /stroke-dasharray="([^"]*)"/.exec(one)?.[1]);
                }, {...line, kind: 'stop_line'});
                assert.match(await page.innerText('#legend'), /poles\s+stop line/);
                assert.deepStrictEqual(dashes, [undefined, '2 6', undefined]);
            });
        },

        async 'a folded rate tells the true one, has a dashed arrow and no speed over ground'() {
            const frames = streamOf('ambiguity');
            const isFolded = target => target.effects.includes('ambiguity');
            const frame = frames.find(one => one.targets.some(isFolded));
            const number = frame.targets.findIndex(isFolded);
            const target = frame.targets[number];
            const truth = target.contributors.reduce((sum, one) => sum + one.weight * one.range_rate_mps, 0);
            assert.ok(Math.abs(target.range_rate_mps - truth) > 90);
            await withPage(view(frames), async page => {
                assert.match(await page.innerText('#legend'), /folded rate/);
                await showFrame(page, frame);
                await page.evaluate(at => chooseTarget(targetsOf(scansOf(state.frame).begin).begin + at), number);
                const text = await panelText(page);
                assert.ok(text.includes(`reported ${target.range_rate_mps.toFixed(2)} m/s, in truth ${truth.toFixed(2)} m/s`), text);
                assert.match(text, /over ground\s+folded: not known/);
                const arrows = () => page.evaluate(() => {
                    const dashes = [];
                    const {setLineDash} = pen;
                    pen.setLineDash = parts => { dashes.push(parts.join()); setLineDash.call(pen, parts); };
                    let count = 0;
                    const whole = drawFoldedRate;
                    drawFoldedRate = (...all) => { count++; whole(...all); };
                    draw();
                    drawFoldedRate = whole;
                    delete pen.setLineDash;
                    return {count, dashed: dashes.includes('3,3')};
                });
                assert.deepStrictEqual(await arrows(), {count: frame.targets.filter(isFolded).length, dashed: true});
                await page.selectOption('#rates', 'compensated');
                assert.strictEqual((await arrows()).count, 0);
                const hits = await page.evaluate(() => plots.rate.hits.length);
                assert.strictEqual(hits, frame.targets.filter(one => !isFolded(one)).length);
            });
        },

        async 'late measurements are drawn where the body was, with their age'() {
            const frames = streamOf('rain');
            const frame = frames.find(one => one.targets.some(target => target.contributors[0].object === 'oncoming_1'));
            const object = frame.objects.find(one => one.id === 'oncoming_1');
            const [sensor] = frame.sensors.list;
            assert.ok(sensor.age_s > 0.04);
            await withPage(view(frames), async page => {
                assert.match(await page.innerText('#legend'), /where the body was when measured/);
                await showFrame(page, frame);
                const box = await page.evaluate(id => {
                    chooseObject(names.indexOf(id));
                    fitView();
                    zoomMiddle(8);
                    const row = objectRow(state.frame, state.object);
                    const {x, y} = toLocal(measuredBox(scansOf(state.frame).begin, row));
                    Object.assign(camera, {x, y});
                    return {x, y};
                }, object.id);
                const ego = frame.objects.find(one => one.id === frame.ego);
                const then = before(object, sensor.age_s);
                assert.ok(Math.abs(ego.yaw_rad) < 1e-9);
                assert.ok(apart(box, {x: then.x - ego.x_m, y: then.y - ego.y_m}) < 1e-3, JSON.stringify(box));
                const {words} = await drawnNow(page);
                assert.ok(words.includes(`${Math.round(1000 * sensor.age_s)} ms before`), words.join());
            });
        },

        async 'side plots have azimuths from the heading, and nothing outside their axes'() {
            for (const name of ['smear', 'ambiguity', 'intersection']) {
                const frames = streamOf(name);
                await withPage(view(frames), async page => {
                    assert.match(await page.getAttribute('#azimuths', 'title'), /azimuth from the vehicle’s heading/);
                    for (const rates of ['raw', 'compensated']) {
                        await page.selectOption('#rates', rates);
                        for (const frame of someOf(frames)) {
                            await showFrame(page, frame);
                            const outside = await page.evaluate(() => {
                                draw();
                                return Object.values(plots).flatMap(({canvas: one, hits}) => hits.filter(({x, y}) =>
                                    x < plotMargin.left || x > one.clientWidth - plotMargin.right ||
                                    y < plotMargin.top || y > one.clientHeight - plotMargin.bottom)).length;
                            });
                            assert.strictEqual(outside, 0, `${name}, frame ${frame.frame}, ${rates}`);
                        }
                    }
                });
            }
            const frame = withMany(streamOf('smear'));
            await withPage(view(streamOf('smear')), async page => {
                await showFrame(page, frame);
                const shown = await page.evaluate(() => {
                    draw();
                    const axes = plotAxes('azimuth');
                    const {canvas: one, hits} = plots.azimuth;
                    const wide = one.clientWidth - plotMargin.left - plotMargin.right;
                    return hits.map(({x}) => axes.left + (x - plotMargin.left) / wide * (axes.right - axes.left));
                });
                const mounts = new Map(frame.sensors.list.map(one => [one.name, one.mount_yaw_rad]));
                frame.sensors.list.flatMap(({name}) => frame.targets.filter(one => one.sensor === name))
                    .forEach((target, i) => {
                        const heading = (target.azimuth_rad + mounts.get(target.sensor)) * 180 / Math.PI;
                        assert.ok(Math.abs(shown[i] - heading) < 0.01, `${shown[i]}, expected ${heading}`);
                    });
            });
        },

        async 'echoes of one reflector tell their paths'() {
            const frames = streamOf('wheels-and-limbs');
            const wordsOf = one => one.path === 'wheel' || one.path === 'limb'
                ? `${one.reflector} by ${one.path} ${one.number}` : `${one.reflector} direct`;
            const alike = frame => frame.targets.filter(one => one.contributors.length === 1 &&
                one.contributors[0].object === 'cyclist' && one.contributors[0].reflector === 'end_f');
            const frame = frames.find(one => alike(one).length >= 3);
            await withPage(view(frames), async page => {
                await showFrame(page, frame);
                await page.evaluate(() => chooseObject(names.indexOf('cyclist')));
                const rows = (await page.locator('#panel .row:not(.lost) .what').allInnerTexts()).map(text => text.split('\n')[0]);
                for (const {contributors: [one]} of alike(frame)) {
                    assert.ok(rows.some(row => row.endsWith(` ${wordsOf(one)} 100 %`)), `${wordsOf(one)}: ${rows}`);
                }
                assert.strictEqual(new Set(alike(frame).map(one => wordsOf(one.contributors[0]))).size, alike(frame).length);
            });
        },

        async 'a lost ghost is called a ghost, and stands on no body'() {
            const frames = streamOf('ghosts');
            const isGhostly = echo => echo.path.includes('wall');
            const lostGhosts = frame => frame.lost.filter(group => ['below_threshold', 'blocked'].includes(group.reason))
                .flatMap(group => group.echoes.filter(isGhostly));
            const frame = structuredClone(frames.find(one => lostGhosts(one).length > 0));
            const [echo] = lostGhosts(frame);
            await withPage(view([{...frame, last: true}]), async page => {
                await showFrame(page, frame);
                const {sensor} = frame.lost.find(group => group.echoes.includes(echo));
                await page.evaluate(([id, at]) => {
                    chooseObject(names.indexOf(id));
                    Object.assign(camera, at, {scale: 20});
                }, [echo.object, placeOf(frame, sensor, echo.range_m, echo.azimuth_rad)]);
                const {words} = await drawnNow(page);
                const label = words.find(word => word.includes(`ghost of ${echo.reflector} `) && /:/.test(word));
                assert.ok(label && label.includes(echo.mirror), words.join('; '));
                assert.ok((await panelText(page)).includes(`ghost of ${echo.reflector} `));
            });
            frame.lost.forEach(group => group.echoes.filter(isGhostly).forEach(one => {
                delete one.range_m;
                delete one.azimuth_rad;
            }));
            await withPage(view([{...frame, last: true}]), async page => {
                await showFrame(page, frame);
                const places = await page.evaluate(id => {
                    chooseObject(names.indexOf(id));
                    return lossesOf(scansOf(state.frame).begin, state.object)
                        .filter(loss => head.paths[loss.path].includes('wall')).map(loss => lossPlace(scansOf(state.frame).begin, loss));
                }, echo.object);
                assert.ok(places.length > 0 && places.every(place => place === null), JSON.stringify(places));
            });
        },

        async 'over time an object without a target has the reasons of its own echoes'() {
            const frame = structuredClone(streamOf('ghosts').find(one => one.objects.some(object => object.id === 'van')));
            const [{name: sensor}] = frame.sensors.list;
            const echo = (reflector, path, number) => ({object: 'van', reflector, path, range_m: 20 + number, azimuth_rad: 0,
                ...(path === 'direct' ? {} : {mirror: 'wall'})});
            const some = (path, count) => Array.from({length: count}, (_, i) => echo(`point_${i}`, path, i));
            const lost = [{sensor, stage: 'ideal', reason: 'blocked', echoes: some('direct', 2).map(one => ({...one, by: 'wall'}))},
                {sensor, stage: 'ideal', reason: 'facing_away', echoes: some('direct', 6).slice(3)},
                {sensor, stage: 'sensor', reason: 'below_threshold',
                    echoes: some('wall_object', 5).map(one => ({...one, shortfall_db: 2})).concat(
                        {...echo('point_2', 'direct', 2), shortfall_db: 1})}];
            const counts = [{sensor, pairs: 6, paths: [{path: 'direct', echoes: 1}, {path: 'wall_object', echoes: 5}]}];
            const bare = {...frame, targets: [], lost, counts, last: true};
            await withPage(view([bare]), async page => {
                await showFrame(page, frame);
                await page.evaluate(() => { chooseObject(names.indexOf('van')); showPane('over-time'); });
                assert.deepStrictEqual(await page.evaluate(() => series.gaps.map(gap => gap.reason)), ['blocked, below threshold']);
                assert.match(await page.evaluate(() => overTimeWords(0)), /: 2 blocked, 1 below threshold$/);
            });
        },

        async 'over time azimuths of all boresights count from the vehicle’s heading'() {
            const frames = streamOf('smear');
            const mounts = new Map(frames[0].sensors.list.map(one => [one.name, one.mount_yaw_rad]));
            assert.ok(new Set(mounts.values()).size > 1);
            await withPage(view(frames), async page => {
                await page.evaluate(() => { chooseObject(-1); showPane('over-time'); });
                const {title, values} = await page.evaluate(() => ({title: overTimePlots[2].title,
                    values: series.points.map(({target, scan}) => overTimePlots[2].value(target, scan))}));
                assert.match(title, /from the heading/);
                const wrap = angle => Math.atan2(Math.sin(angle), Math.cos(angle));
                const expected = frames.flatMap(frame => frame.sensors.list.flatMap(({name}) => frame.targets
                    .filter(one => one.sensor === name).map(one => wrap(one.azimuth_rad + mounts.get(name)) * 180 / Math.PI)));
                assert.strictEqual(values.length, expected.length);
                expected.forEach((value, i) => assert.ok(Math.abs(values[i] - value) < 1e-3, `${values[i]}, expected ${value}`));
            });
        },

        async 'page and comparison have the same marks, one for each kind of target'() {
            const frame = withMany(streamOf('intersection'));
            await withPage(view([{...frame, last: true}]), async page => {
                const marks = await page.evaluate(() => ['body', 'ghost', 'clutter', 'false_alarm', 'truth'].map(kind =>
                    symbolCanvas(0, '#000', 24, kind).toDataURL()));
                assert.strictEqual(new Set(marks).size, 5);
            });
            const other = path.join(fs.mkdtempSync(path.join(require('node:os').tmpdir(), 'truth-')), 'truth.jsonl');
            fs.writeFileSync(other, JSON.stringify({...frame, last: true}) + '\n');
            await withPage(view([{...frame, targets: frame.targets.slice(1), last: true, sections: undefined,
                lost: undefined, counts: undefined}], '--truth', other), async page => {
                await page.click('[aria-controls=comparison]');
                assert.ok(await page.evaluate(() => document.querySelector('#comparison tr.missed canvas').toDataURL() ===
                    symbolCanvas(sensorStyle(scansOf(state.frame).begin), ink.ink, 18, 'truth').toDataURL()));
            });
        },

        async 'pictures of the pages have a ground of their own in light and dark pages, and say where an axis is linear'() {
            const pictures = ['accuracy', 'figures'].flatMap(folder => fs.readdirSync(path.join(root, 'data', folder))
                .filter(name => name.endsWith('.svg')).map(name => path.join(root, 'data', folder, name)));
            assert.ok(pictures.length > 15);
            for (const colorScheme of ['light', 'dark']) {
                await withPage(view([]), async page => {
                    const clear = await page.evaluate(async texts => {
                        const found = [];
                        for (const [name, text] of texts) {
                            const frame = new DOMParser().parseFromString(text, 'image/svg+xml').documentElement;
                            document.body.append(document.adoptNode(frame));
                            const [ground] = frame.querySelectorAll('rect');
                            const fill = getComputedStyle(ground).fill;
                            const all = ['width', 'height'].every(side =>
                                ground[side].baseVal.value >= frame.viewBox.baseVal[side] - 1);
                            if (!all || !/^rgb\(/.test(fill)) {
                                found.push(`${name}: ${fill}`);
                            }
                            frame.remove();
                        }
                        return found;
                    }, pictures.map(file => [file, fs.readFileSync(file, 'utf8')]));
                    assert.deepStrictEqual(clear, []);
                }, {colorScheme}, [/Content Security Policy/]);
            }
            for (const file of pictures.filter(name => /cost-|tracker/.test(name))) {
                assert.match(fs.readFileSync(file, 'utf8'), /linear within ±0\.2, logarithmic beyond/, file);
            }
        },

        async 'a sentence says what the frame shows'() {
            const numbers = ['No', 'One', 'Two', 'Three', 'Four'];
            for (const name of ['intersection', 'two-vehicles', 'clutter', 'ghosts', 'snow', 'coherence']) {
                const frames = streamOf(name);
                await withPage(view(frames), async page => {
                    for (const frame of someOf(frames)) {
                        await showFrame(page, frame);
                        const kindOf = one => one.contributors[0].path;
                        const bodies = frame.targets.filter(one => !['clutter', 'false_alarm'].includes(kindOf(one)));
                        const objects = new Set(bodies.flatMap(one => one.contributors.map(part => part.object))).size;
                        const merged = bodies.filter(one => new Set(one.contributors.map(part => part.object)).size > 1);
                        const ghosts = bodies.filter(one => /wall/.test(kindOf(one))).length;
                        const count = kind => frame.targets.filter(one => kindOf(one) === kind).length;
                        const silent = ['facing_away', 'no_specular_point', 'out_of_range', 'out_of_view', 'switched_off'];
                        const lost = frame.lost.filter(group => !silent.includes(group.reason))
                            .reduce((sum, group) => sum + group.echoes.length, 0);
                        const radars = frame.sensors.list.length;
                        const band = Math.round(frame.sensors.list[0].carrier_hz / 1e9);
                        const s = (number, one, many) => `${number} ${number === 1 ? one : many}`;
                        const parts = [s(bodies.length, 'target', 'targets') +
                            (objects > 0 ? ` of ${s(objects, 'object', 'objects')}` : '')];
                        parts.push(...(merged.length ? [`${merged.length} merged`] : []),
                            ...(ghosts ? [s(ghosts, 'a ghost', 'ghosts')] : []),
                            ...(count('clutter') ? [`${count('clutter')} of clutter`] : []),
                            ...(count('false_alarm') ? [s(count('false_alarm'), 'false alarm', 'false alarms')] : []),
                            ...(lost ? [`${s(lost, 'echo', 'echoes')} lost`] : []));
                        assert.strictEqual(await page.innerText('#sentence'),
                            `${numbers[radars]} ${band} GHz radar${radars === 1 ? '' : 's'}, ` +
                            `${frame.scene.replace('/' + frame.ego, '')}, frame ${frame.frame} of ${frames.length}: ` +
                            (frame.sensors.list.some(one => one.measured) ? parts.join(', ')
                                : 'no radar measured in this frame'));
                    }
                });
            }
        },

        async 'effect scenes open with a target of that effect on screen, and the ego in the lower third'() {
            const about = {
                accuracy: 'accuracy', ambiguity: 'ambiguity', clutter: 'clutter', coherence: 'coherence',
                'false-alarms': 'false_alarms', level: 'level', ghosts: 'ghosts',
                interference: 'interference', misalignment: 'misalignment', rain: 'rain',
                'range-migration': 'range_migration', 'road-mirror': 'two_ray', shadows: 'height', snow: 'snow',
                'wheels-and-limbs': 'wheels', 'two-vehicles': 'merging', contour: 'coherence',
            };
            for (const name of pipelines) {
                const frames = streamOf(name);
                for (const viewport of [{width: 1280, height: 800}, {width: 400, height: 800}]) {
                    await withPage(view(frames), async page => {
                        const {number, area, camera, scene} = await page.evaluate(() => ({
                            number: frameNumber(state.frame), scene: names[head.scenes[state.scene].name],
                            area: {x: canvas.clientWidth, y: canvas.clientHeight}, camera: {...camera},
                        }));
                        const frame = frames.find(one => one.frame === number && one.scene === scene);
                        const ego = area.y / 2 + camera.x * camera.scale;
                        assert.ok(ego > 2 / 3 * area.y && ego < area.y, `${name}: the ego is ${ego} of ${area.y} px down`);
                        const legend = await page.evaluate(() => ({x: control('legend').offsetLeft +
                            control('legend').offsetWidth, y: control('legend').offsetTop + control('legend').offsetHeight}));
                        // The farthest are off the map where it would show more than 120 m; the page tells how many.
                        const tooFar = await page.evaluate(() =>
                            cameraFor(placesToFit().concat(placesToOpen())).scale < canvas.clientHeight / 120);
                        const shown = frame.targets.filter(target => {
                            const at = placeOf(frame, target.sensor, target.range_m, target.azimuth_rad);
                            const x = area.x / 2 - (at.y - camera.y) * camera.scale;
                            const y = area.y / 2 - (at.x - camera.x) * camera.scale;
                            assert.ok(tooFar || x > legend.x || y > legend.y, `${name}: a target is under the legend`);
                            return x > 0 && x < area.x && y > 0 && y < area.y;
                        });
                        const listed = frame.targets.filter(one => one.contributors[0].path !== 'false_alarm');
                        assert.ok(shown.length > 0 && (tooFar || listed.every(one => shown.includes(one))),
                            `${name}: ${shown.length} of ${frame.targets.length}`);
                        assert.strictEqual(await page.isHidden('#outside'), shown.length === frame.targets.length);
                        if (shown.length < frame.targets.length) {
                            assert.strictEqual(await page.innerText('#outside'), `${frame.targets.length - shown.length} ` +
                                `target${frame.targets.length - shown.length === 1 ? '' : 's'} off the map`);
                            await page.click('#outside');
                            await page.waitForFunction(() => control('outside').hidden);
                        }
                        if (about[name]) {
                            assert.ok(shown.some(one => one.effects.includes(about[name])), `${name}: ${about[name]}`);
                        }
                    }, {viewport});
                }
            }
        },

        async 'a target so far away that the map would show more than 120 m is left out of the first view'() {
            const [frame] = streamOf('corner').filter(one => one.targets.length === 5);
            for (const [range, off] of [[60, false], [900, true]]) {
                const contributors = frame.targets[0].contributors.map(one => ({...one, object: 'another'}));
                const far = {...frame.targets[0], range_m: range, azimuth_rad: 0, contributors};
                const alone = {...frame, targets: [...frame.targets, far], lost: undefined, counts: undefined,
                    sections: undefined, last: true};
                await withPage(view([alone]), async page => {
                    assert.ok(await page.evaluate(() => canvas.clientHeight / camera.scale) <= 120);
                    assert.strictEqual(await page.isVisible('#outside'), off, `${range} m`);
                    if (off) {
                        assert.strictEqual(await page.innerText('#outside'), '1 target off the map');
                    }
                });
            }
        },

        async 'objects with targets are labelled before others, and rulers have numbers'() {
            const frames = streamOf('intersection');
            const frame = withMany(frames);
            await withPage(view(frames), async page => {
                await showFrame(page, frame);
                const {words, circles} = await drawnNow(page);
                const listed = new Set(frame.targets.map(one => one.contributors[0].object));
                const last = Math.max(...[...listed].map(id => words.findIndex(word => word.startsWith(id)))
                    .filter(at => at >= 0));
                const others = frame.objects.filter(one => !listed.has(one.id) && one.id !== frame.ego)
                    .map(one => words.findIndex(word => word.startsWith(one.id))).filter(at => at >= 0);
                assert.ok(last > 0 && others.length > 0);
                assert.ok(others.every(at => at > last), words.join());
                const rings = words.filter(word => /^\d+ m$/.test(word)).map(word => parseFloat(word));
                assert.ok(rings.length >= 2, words.join());
                for (const range of rings) {
                    assert.ok(circles.some(one => apart(one, {x: 0, y: 0}) < 0.1), String(range));
                }
                assert.ok(words.filter(word => /^[−\d]+$/.test(word)).length >= 6, words.join());
                assert.ok(words.includes('axes: m ahead and left of the ego'));
            });
        },

        async 'labels of bodies lie over no other body where there is room beside them'() {
            for (const name of ['3gpp', 'snow', 'intersection']) {
                const frames = streamOf(name);
                await withPage(view(frames), async page => {
                    const labels = await page.evaluate(() => {
                        const found = [];
                        const whole = labelObject;
                        labelObject = (box, text, colour) => {
                            const before = taken.length;
                            whole(box, text, colour);
                            found.push(...taken.slice(before).map(label => ({label, own: boundsOf(box)})));
                        };
                        draw();
                        labelObject = whole;
                        const {begin, end} = objectsOf(state.frame);
                        const all = Array.from({length: end - begin}, (_, i) => boundsOf(boxOf(begin + i)));
                        const meet = (a, b) => a.x < b.x + b.width && b.x < a.x + a.width &&
                            a.y < b.y + b.height && b.y < a.y + a.height;
                        return found.map(({label, own}) =>
                            all.filter(one => JSON.stringify(one) !== JSON.stringify(own) && meet(label, one)).length);
                    });
                    assert.ok(labels.length >= 4 && labels.every(count => count === 0), `${name}: ${labels}`);
                });
            }
        },

        async 'a target of many centres names its strongest ones and says how many more there are'() {
            const frames = streamOf('contour');
            const frame = withMany(frames);
            await withPage(view(frames), async page => {
                await showFrame(page, frame);
                const rows = await page.locator('h3:has-text("front") ~ .row:not(.lost, .silent) .what').allInnerTexts();
                const listed = frame.targets.map(({contributors: parts}) => {
                    const sorted = [...parts].sort((a, b) => b.weight - a.weight);
                    const more = parts.length > 5 ? parts.length - 4 : 0;
                    return [sorted[0].object, more];
                });
                assert.ok(listed.some(([, more]) => more > 0));
                listed.forEach(([object, more], i) => {
                    assert.ok(rows[i].includes(object), rows[i]);
                    assert.strictEqual((/ and (\d+) more$/.exec(rows[i]) || [0, '0'])[1], String(more), rows[i]);
                });
            });
        },

        async 'numbers of rulers are whole, or not there'() {
            for (const name of ['side', 'road-mirror', 'intersection']) {
                await withPage(view(streamOf(name)), async page => {
                    const {tops, low, size} = await page.evaluate(() => {
                        const found = [];
                        const whole = rulerText;
                        rulerText = (text, x, y) => {
                            const before = taken.length;
                            whole(text, x, y);
                            found.push(...taken.slice(before));
                        };
                        draw();
                        rulerText = whole;
                        return {tops: found.map(one => one.y), low: found.map(one => one.y + one.height),
                            size: canvas.clientHeight};
                    });
                    assert.ok(tops.length > 6 && tops.every(y => y >= 0) && low.every(y => y <= size), `${name}: ${tops}`);
                });
            }
        },

        async 'the ego has its name, however small it is'() {
            for (const name of ['ghosts', 'ambiguity', 'snow']) {
                for (const viewport of [{width: 1280, height: 800}, {width: 400, height: 800}]) {
                    await withPage(view(streamOf(name)), async page => {
                        const words = await page.evaluate(() => {
                            const found = [];
                            pen.fillText = text => found.push(text);
                            draw();
                            delete pen.fillText;
                            return found;
                        });
                        assert.ok(words.includes('ego'), `${name}: ${words}`);
                    }, {viewport});
                }
            }
        },

        async 'with nothing chosen road users without a target are listed, and tell why by keyboard alone'() {
            const frames = streamOf('intersection');
            const frame = withMany(frames);
            const seen = new Set([frame.ego, ...frame.targets.flatMap(one => one.contributors.map(part => part.object))]);
            const silent = frame.objects.filter(one => !seen.has(one.id) && !['guardrail', 'post', 'wall'].includes(one.class))
                .map(one => one.id);
            assert.ok(silent.length > 2);
            await withPage(view(frames), async page => {
                await showFrame(page, frame);
                const rows = page.locator('h3:has-text("Road users without a target") ~ .row');
                assert.deepStrictEqual((await rows.locator('.what').allInnerTexts()).map(text => text.replace(/ \(.*/, '')), silent);
                const hidden = frame.lost.find(group => group.reason === 'blocked').echoes
                    .find(echo => silent.includes(echo.object)).object;
                await rows.nth(silent.indexOf(hidden)).focus();
                await page.keyboard.press('Enter');
                assert.match(await panelText(page), new RegExp(`^${hidden}[^]*blocked by`));
            });
        },

        async 'with nothing chosen losses are counted by reason, and drawn on demand'() {
            for (const name of ['intersection', 'clutter', 'snow']) {
                const frames = streamOf(name);
                const frame = withMany(frames);
                await withPage(view(frames), async page => {
                    await showFrame(page, frame);
                    const counts = new Map();
                    for (const group of frame.lost) {
                        const key = `${group.stage}/${group.reason}`;
                        counts.set(key, (counts.get(key) || 0) + group.echoes.length);
                    }
                    const rows = page.locator('#panel .row.lost, #panel .row.silent');
                    const listed = await rows.locator('b').allInnerTexts();
                    assert.deepStrictEqual(listed.map(Number).sort((a, b) => a - b),
                        [...counts.values()].sort((a, b) => a - b));
                    for (let i = 0; i < listed.length; i++) {
                        await page.evaluate(() => {
                            window.marks = 0;
                            const whole = window.wholeMark = window.wholeMark || drawLostMark;
                            drawLostMark = (...all) => { window.marks++; whole(...all); };
                        });
                        await rows.nth(i).click();
                        const marks = await page.evaluate(() => { window.marks = 0; draw(); return window.marks; });
                        assert.strictEqual(marks, Number(listed[i]), `${name}, row ${i}`);
                    }
                    await rows.nth(listed.length - 1).click();
                    assert.strictEqual(await page.evaluate(() => state.cause), null);
                });
            }
        },
    };
};
