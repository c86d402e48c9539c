// Prints how fast pages of glint-view open and play: one of 200 objects and four radars, one of 50,000
// frames. Time decides no test, so this is run by hand, after `make` and `tests/browser/run`:
// PATH=$PWD/build/bin:$PATH NODE_PATH=build/browser/node_modules node tests/browser/measure.js

const {execSync} = require('node:child_process');
const fs = require('node:fs');
const os = require('node:os');
const path = require('node:path');
const {launch, open} = require('./browser.js');

const frameLoop = `new Promise(resolve => {
    const begin = performance.now();
    let shown = 0;
    let last = state.row;
    state.pace = 2;
    showRow(0);
    setPlaying(true);
    const count = now => {
        shown += state.row !== last ? 1 : 0;
        last = state.row;
        if (now - begin < 4000 && state.playing) {
            requestAnimationFrame(count);
        } else {
            setPlaying(false);
            resolve(1000 * shown / (now - begin));
        }
    };
    requestAnimationFrame(count);
})`;

// The time that the page's main thread works for each of the first 200 frames, in ms: scripts, style
// and layout. It is the thread's own time, so other programs on the machine do not count.
async function threadTime(page, drawing) {
    const devtools = await page.context().newCDPSession(page);
    await devtools.send('Performance.enable', {timeDomain: 'threadTicks'});
    const worked = async () => (await devtools.send('Performance.getMetrics')).metrics
        .find(one => one.name === 'TaskDuration').value;
    const before = await worked();
    await page.evaluate(drawn => {
        for (let row = 0; row < 200; row++) {
            showRow(row);
            if (drawn) {
                draw();
            }
            document.body.offsetHeight; // lays the page out
        }
    }, drawing);
    const after = await worked();
    await devtools.detach();
    return 1000 * (after - before) / 200;
}

async function measure(browser, work, name, objects, frames, sensors) {
    const scene = path.join(work, 'scene.json');
    const file = path.join(work, 'page.html');
    execSync(`${path.join(__dirname, 'make-traffic')} ${objects} ${frames} >${scene} && glint-traffic ${scene} | ` +
        `glint-extract | glint-ideal --sensors ${sensors} --sections account | glint-sensor | glint-noise | glint-view -o ${file}`);
    const begin = Date.now();
    const {page} = await open(browser, file);
    await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
    const opened = Date.now() - begin;
    console.log(`${name}: ${Math.round(fs.statSync(file).size / 1e6)} MB, ` +
        `${await page.evaluate(() => column('target_range_m').length / sceneFrames[0].length | 0)} targets a frame`);
    console.log(`  open and drawn after ${opened} ms`);
    for (const [pane, object] of [['panel', 'an object'], ['panel', 'none'], ['targets', ''], ['over-time', '']]) {
        await page.evaluate(([id, chosen]) => {
            chooseObject(chosen === 'none' ? -1 : state.object);
            showPane(id);
        }, [pane, object]);
        console.log(`  pane ${pane}${object ? `, ${object} chosen` : ''}: ` +
            `${(await threadTime(page, false)).toFixed(2)} ms a frame`);
    }
    await page.evaluate(() => showPane('targets'));
    console.log(`  with map and plots drawn: ${(await threadTime(page, true)).toFixed(2)} ms a frame`);
    console.log(`  played at twice the pace: ${(await page.evaluate(frameLoop)).toFixed(1)} frames a second shown`);
    await page.context().close();
}

async function main() {
    const work = fs.mkdtempSync(path.join(os.tmpdir(), 'glint-measure-'));
    const browser = await launch();
    await measure(browser, work, '200 objects, four radars', 200, 300, 'corner77-four');
    await measure(browser, work, '50,000 frames', 30, 50000, 'srr24-pair');
    await browser.close();
    fs.rmSync(work, {recursive: true});
}

main();
