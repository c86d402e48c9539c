// Tests of two streams over each other and of tracks, against glint-score and glint-score-tracks.

const assert = require('node:assert');
const {execFileSync, execSync} = require('node:child_process');
const fs = require('node:fs');
const path = require('node:path');

module.exports = ({work, write, view, withPage}) => {
    const file = name => path.join(work, name);
    execSync('glint-traffic intersection | glint-extract | glint-ideal --sensors srr24-pair --sections account | ' +
        `glint-sensor >${file('cells.jsonl')} && glint-noise-none ${file('cells.jsonl')} >${file('truth.jsonl')} && ` +
        `glint-noise ${file('cells.jsonl')} >${file('list.jsonl')}`, {shell: '/bin/bash'});
    const lines = name => fs.readFileSync(file(name), 'utf8').trim().split('\n').map(line => JSON.parse(line));
    const list = lines('list.jsonl');
    const run = (program, ...words) => execFileSync(program, words, {maxBuffer: 1 << 28}).toString().trim();

    // A tracker that follows all objects but one, takes another id for one of them, and has a ghost.
    function tracks() {
        const seen = new Map();
        list.forEach(frame => frame.targets.forEach(({contributors: [{object}]}) =>
            seen.set(object, (seen.get(object) || new Set()).add(frame.frame))));
        const [first, ...others] = [...seen.keys()].sort((a, b) => seen.get(b).size - seen.get(a).size);
        const frames = [...seen.get(others[0])];
        const change = frames[Math.floor(frames.length / 2)];
        return list.map(frame => ({scene: frame.scene, frame: frame.frame, tracks: [
            ...frame.objects.filter(one => others.includes(one.id)).map(one => ({
                id: `${one.id === others[0] && frame.frame >= change ? 'new' : 'old'} ${one.id}`,
                x_m: one.x_m + 0.5, y_m: one.y_m, vx_mps: one.vx_mps, vy_mps: one.vy_mps})),
            {id: `nothing near ${first}`, x_m: 1000, y_m: 0, vx_mps: 0, vy_mps: 0},
        ]}));
    }

    return {
        async 'matched, missed and false targets are those of glint-score, in each frame and in all'() {
            const scores = run('glint-score', '--truth', file('truth.jsonl'), file('list.jsonl')).split('\n')
                .map(line => JSON.parse(line).sensors.reduce((sum, one) => ({
                    pairs: sum.pairs + one.pair_count, missed: sum.missed + one.missed_count,
                    false: sum.false + one.false_count}), {pairs: 0, missed: 0, false: 0}));
            const {all} = JSON.parse(run('glint-score', '--summary', '--truth', file('truth.jsonl'), file('list.jsonl')));
            assert.ok(all.missed_count > 0 && all.false_count > 0);
            await withPage(view(list, '--truth', file('truth.jsonl')), async page => {
                await page.click('[aria-controls=comparison]');
                const shown = await page.evaluate(() => sceneFrames[0].map((_, row) => {
                    showRow(row);
                    return document.getElementById('comparison').textContent;
                }));
                scores.forEach((one, i) => assert.ok(shown[i].includes(
                    `In this frame ${one.pairs} matched, ${one.missed} missed, ${one.false} false.`), shown[i]));
                const text = await page.innerText('#comparison');
                assert.ok(text.includes(`In the whole scene ${all.pair_count} matched, ${all.missed_count} missed, ` +
                    `${all.false_count} false`), text);
                assert.ok(text.includes(`${all.range_rate_mps.rms.toFixed(2)} m/s`), text);
                assert.ok(text.includes(`${all.amplitude_db.rms.toFixed(2)} dB`), text);
                assert.match(await page.innerText('#legend'), /missed target/);
            });
        },

        async 'a key goes to the next frame that differs, and its difference is drawn'() {
            const scores = run('glint-score', '--truth', file('truth.jsonl'), file('list.jsonl')).split('\n')
                .map(line => JSON.parse(line));
            const differs = scores.filter(line => line.sensors.some(one => one.missed_count + one.false_count > 0));
            await withPage(view(list, '--truth', file('truth.jsonl'), '--frame', '0'), async page => {
                for (const line of differs.filter(({frame}) => frame > 0).slice(0, 3)) {
                    await page.keyboard.press('u');
                    assert.strictEqual(await page.evaluate(() => frameNumber(state.frame)), line.frame);
                }
                const red = await page.evaluate(() => {
                    const missed = pairsOfFrame(state.frame).find(pair => kindOfPair(pair) !== 'matched');
                    const at = toLocal(missed.truth >= 0 ? truePlace(missed.scan, missed.truth)
                        : targetPlace(missed.scan, missed.target));
                    Object.assign(camera, at);
                    draw();
                    const {data} = pen.getImageData(canvas.width / 2 - 20, canvas.height / 2 - 20, 40, 40);
                    return [...data].filter((_, i) => i % 4 === 0 && data[i] > 150 && data[i + 1] < 80).length;
                });
                assert.ok(red > 20, String(red));
            });
        },

        async 'each missed and each false target is an event of its own'() {
            const {all} = JSON.parse(run('glint-score', '--summary', '--truth', file('truth.jsonl'), file('list.jsonl')));
            await withPage(view(list, '--truth', file('truth.jsonl')), async page => {
                await page.click('[aria-controls=over-time]');
                const title = page.locator('#lanes [data-kind=difference]');
                assert.strictEqual(await title.innerText(), `differences: ${all.missed_count + all.false_count}`);
                await title.click();
                const first = await page.evaluate(() => eventsOfScene().difference.indexOf(events.shown));
                await page.keyboard.press('.');
                assert.deepStrictEqual([first, await page.evaluate(() => eventsOfScene().difference.indexOf(events.shown))], [0, 1]);
            });
        },

        async 'tracks have ids and switches, as glint-score-tracks counts them'() {
            fs.writeFileSync(file('tracks.jsonl'), write(tracks()));
            const score = JSON.parse(run('glint-score-tracks', '--tracks', file('tracks.jsonl'), '--summary',
                file('list.jsonl')));
            assert.ok(score.id_switches > 0 && score.all.missed_count > 0);
            await withPage(view(list, '--tracks', file('tracks.jsonl')), async page => {
                await page.click('[aria-controls=comparison]');
                const counts = await page.evaluate(() => {
                    const has = name => [...column(name)].map(number => number > 0);
                    const ids = has('track_id');
                    const objects = has('track_object');
                    const excused = has('track_excused');
                    return {pair_count: ids.filter((one, i) => one && objects[i]).length,
                        missed_count: ids.filter((one, i) => !one && objects[i]).length,
                        false_count: ids.filter((one, i) => one && !objects[i] && !excused[i]).length};
                });
                for (const name of Object.keys(counts)) {
                    assert.strictEqual(counts[name], score.all[name], name);
                }
                assert.ok(await page.evaluate(() => column('track_excused').includes(1)), 'tracks on objects out of view');
                assert.match(await page.innerText('#comparison'),
                    new RegExp(`Identity switches in the whole scene: ${score.id_switches}\\.`));
                await page.keyboard.press('Home');
                await page.keyboard.press('u');
                assert.match(await page.innerText('#comparison'), /before old/);
            });
        },

        async 'road users without a track are missed, walls are not; the legend has their marks'() {
            const walled = structuredClone(list);
            const standing = walled[0].objects.find(one => one.id !== walled[0].ego).id;
            walled.forEach(frame => frame.objects.filter(one => one.id === standing).forEach(one => { one.class = 'wall'; }));
            fs.writeFileSync(file('none.jsonl'), write(list.map(({scene, frame}) => ({scene, frame, tracks: []}))));
            for (const [frames, counts] of [[list, true], [walled, false]]) {
                await withPage(view(frames, '--tracks', file('none.jsonl')), async page => {
                    const rows = await page.evaluate(() => sceneFrames[0].flatMap(frame => tracksOf(frame))
                        .map(i => nameOrNone('track_object', i)));
                    assert.strictEqual(rows.includes(standing), counts);
                    assert.ok(rows.some(one => one !== standing));
                    const legend = await page.innerText('#legend');
                    ['track, with its id', 'track of no object', 'road user without a track']
                        .forEach(text => assert.ok(legend.includes(text), text));
                    const misses = await page.evaluate(() => (eventsOfScene().miss || []).map(({object}) => names[object]));
                    assert.strictEqual(misses.includes(standing), counts);
                });
            }
        },

        async 'scans of one stream alone are counted as glint-score counts them, and have no false targets'() {
            const slow = (frames, every) => frames.map(frame => frame.frame % every === 0 ? frame : {...frame,
                sensors: {...frame.sensors, list: frame.sensors.list.map(one => ({...one, measured: false}))},
                targets: []});
            fs.writeFileSync(file('every3.jsonl'), write(slow(lines('truth.jsonl'), 3)));
            const every2 = slow(list.map(({counts, lost, ...frame}) => ({...frame, sections: []})), 2);
            fs.writeFileSync(file('every2.jsonl'), write(every2));
            const {all} = JSON.parse(run('glint-score', '--summary', '--truth', file('every3.jsonl'), file('every2.jsonl')));
            assert.ok(all.true_scans > 0 && all.listed_scans > all.true_scans);
            await withPage(view(every2, '--truth', file('every3.jsonl'), '--frame', '2'), async page => {
                await page.click('[aria-controls=comparison]');
                const text = await page.innerText('#comparison');
                assert.ok(text.includes('In this frame 0 matched, 0 missed, 0 false.'), text);
                assert.ok(text.includes('Not compared: 2 scans of this stream alone.'), text);
                assert.ok(text.includes(`In the whole scene ${all.pair_count} matched, ${all.missed_count} missed, ` +
                    `${all.false_count} false`), text);
                assert.ok(text.includes(`Not compared: ${all.true_scans} scans of the other stream alone, ` +
                    `${all.listed_scans} scans of this stream alone.`), text);
            });
        },

        async 'a frame that the other stream lacks is told'() {
            fs.writeFileSync(file('half.jsonl'), write(lines('truth.jsonl').slice(0, 100)));
            await withPage(view(list, '--truth', file('half.jsonl'), '--frame', '150'), async page => {
                await page.click('[aria-controls=comparison]');
                assert.match(await page.innerText('#comparison'), /The other stream has no such frame/);
            });
        },
    };
};
