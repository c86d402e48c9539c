// The time line: a band of counts over the slider, going to a frame or a time, loops, and the way
// from scene to scene.

const band = document.getElementById('band');
const bandContext = band.getContext('2d');
const oneFrameSeconds = 0.5; // how long Play stays at a scene of one frame, at the pace 1

let targetCounts = {scene: -1, of: []};

// How many targets each frame of the scene has.
function countsOfScene() {
    if (targetCounts.scene !== state.scene) {
        const begin = starts('scan_targets');
        targetCounts = {scene: state.scene, of: sceneFrames[state.scene].map(frame => {
            const scans = scansOf(frame);
            return begin[scans.end] - begin[scans.begin];
        })};
    }
    return targetCounts.of;
}

// The place of a row on the slider, whose thumb stays within its ends.
function bandPlace(row, rows, width) {
    return 8 + (width - 16) * (rows > 1 ? row / (rows - 1) : 0.5);
}

function drawBand() {
    const {width, height} = fitCanvas(band, bandContext);
    const counts = countsOfScene();
    const most = counts.reduce((high, count) => Math.max(high, count), 1);
    const step = Math.max(1, (width - 16) / Math.max(1, counts.length - 1));
    const tallest = new Float32Array(Math.ceil(width) + 1);
    counts.forEach((count, row) => {
        const x = Math.round(bandPlace(row, counts.length, width));
        tallest[x] = Math.max(tallest[x], count);
    });
    bandContext.fillStyle = ink.edge;
    tallest.forEach((count, x) => {
        const tall = (height - 2) * count / most;
        bandContext.fillRect(x - step / 2 - 0.5, height - tall, step + 1, tall);
    });
    control('most').textContent = `up to ${plural(most, 'target')}`;
}

function showTimeline() {
    control('next-scene').hidden = control('last-scene').hidden = head.scenes.length < 2;
    drawBand();
}

// The row of the last frame that is not later than a time, as the clock shows it. Columns have times in
// single precision, with 24 bits.
function rowOfTime(time) {
    return rowAt(sceneFrames[state.scene], time + Math.max(0.0005, time * 2 ** -24));
}

// Goes to the frame of a number, or to a time: "120", "4.8 s".
function goTo(text) {
    const asked = /^\s*(-?\d+(?:\.\d+)?)\s*(s?)\s*$/.exec(text);
    const frames = sceneFrames[state.scene];
    const row = !asked ? -1
        : asked[2] || asked[1].includes('.')
            ? rowOfTime(Number(asked[1]) - head.scenes[state.scene].start_s)
            : frames.findIndex(frame => frameNumber(frame) === Number(asked[1]));
    control('goto').setCustomValidity(row < 0 ? 'A frame of this scene, or a time such as 4.8 s' : '');
    if (control('goto').reportValidity()) {
        setPlaying(false);
        showRow(row);
    }
}

function stepScene(step) {
    const next = state.scene + step;
    if (next >= 0 && next < head.scenes.length) {
        setScene(next);
    }
}

function isOneFrame(scene) {
    return scene < head.scenes.length && sceneFrames[scene].length === 1;
}

// Where Play goes at the end of a scene: the next scene if this one or that one has one frame, the
// beginning in a loop; -1 stops it.
function sceneAfter() {
    const next = state.scene + 1;
    if (next < head.scenes.length && (isOneFrame(state.scene) || isOneFrame(next))) {
        return next;
    }
    return !state.loop ? -1 : isOneFrame(state.scene) ? 0 : state.scene;
}

function playFromEnd() {
    const next = sceneAfter();
    if (next < 0) {
        setPlaying(false);
    } else if (next === state.scene) {
        showRow(0);
        startClock();
    } else {
        setScene(next, {row: 0, object: -1});
        setPlaying(true);
    }
}

function setLoop(loop) {
    state.loop = loop;
    control('loop').setAttribute('aria-pressed', String(loop));
}

function connectTimeline() {
    control('next-scene').addEventListener('click', () => stepScene(1));
    control('last-scene').addEventListener('click', () => stepScene(-1));
    control('loop').addEventListener('click', () => setLoop(!state.loop));
    const field = control('goto');
    field.addEventListener('keydown', event => {
        field.setCustomValidity('');
        if (event.key === 'Enter') {
            goTo(field.value);
        }
        if (event.key === 'Escape' || event.key === 'Enter' && field.validity.valid) {
            field.blur();
        }
        event.stopPropagation();
    });
    field.addEventListener('blur', () => { field.value = ''; });
    new ResizeObserver(drawBand).observe(band);
}
