// Prints how fast a page of glint-view opens and plays. Time decides no test, so this is run by hand:
// tests/browser/make-traffic >many.json; glint-traffic ./many.json | ... | glint-view -o many.html;
// NODE_PATH=build/browser/node_modules node tests/browser/measure.js many.html

const path = require('node:path');
const {launch, open} = require('./browser.js');

async function playedFrames(page) {
    return page.evaluate(() => new Promise(resolve => {
        const begin = performance.now();
        let shown = 0;
        let last = state.row;
        document.getElementById('pace').value = '2';
        document.getElementById('pace').dispatchEvent(new Event('change'));
        showRow(0);
        setPlaying(true);
        const count = now => {
            shown += state.row !== last ? 1 : 0;
            last = state.row;
            if (now - begin < 4000) {
                requestAnimationFrame(count);
            } else {
                setPlaying(false);
                resolve(1000 * shown / (now - begin));
            }
        };
        requestAnimationFrame(count);
    }));
}

async function drawingTime(page) {
    return page.evaluate(() => {
        const rows = Math.min(500, sceneFrames[0].length);
        const begin = performance.now();
        for (let row = 0; row < rows; row++) {
            showRow(row);
            draw();
        }
        return (performance.now() - begin) / rows;
    });
}

async function main() {
    const browser = await launch();
    const begin = Date.now();
    const {page} = await open(browser, path.resolve(process.argv[2]));
    await page.evaluate(() => new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done))));
    const opened = Date.now() - begin;
    console.log(`${await page.evaluate(() => sceneFrames[0].length)} frames: open and drawn after ${opened} ms`);
    console.log(`one frame, panel and plots included: ${(await drawingTime(page)).toFixed(2)} ms of script`);
    console.log(`played at twice the pace: ${(await playedFrames(page)).toFixed(1)} frames a second shown`);
    await browser.close();
}

main();
