// The state of the page: what is shown and chosen, the clock, the controls and the keys.

const state = {
    scene: 0,
    row: 0, // index among the scene's frames
    frame: -1, // index among all frames of the stream; -1: none
    ego: null,
    fresh: true, // nobody has chosen anything yet
    object: -1, // chosen object, by the number of its id in names; -1: none
    reflector: null,
    echo: null, // the one echo of the chosen reflector that was clicked; null: all
    cause: null, // stage and reason of the losses that are drawn while nothing is chosen
    target: -1,
    hover: -1, // target under the pointer; -1: none
    pane: 'panel', // what is shown beside the map
    loop: false,
    large: '', // side plot over the map: azimuth or rate
    event: '', // kind of the events that keys step through; '': every kind
    colour: 'sensor',
    effect: -1, // effect whose targets are coloured; -1: colour by `colour`
    rates: 'raw',
    up: 'up',
    follow: true,
    trail: true,
    playing: false,
    pace: 1,
    fastest: 1, // largest range rate, as the plots show it
    rateScale: 1,
    amplitudes: {low: 0, high: 1},
    limits: {range: 30, azimuth: 90, rate: 10},
};

const control = id => document.getElementById(id);

let drawn = true;

function redraw() {
    if (drawn) {
        drawn = false;
        requestAnimationFrame(draw);
    }
}

function draw() {
    drawn = true;
    drawMap();
    drawHover();
    if (state.frame >= 0) {
        rememberPlace();
    }
    if (!control('plots').hidden) {
        drawPlots();
    }
}

function refresh() {
    if (state.frame >= 0) {
        fillPane();
        showSentence();
    }
    redraw();
}

// Choosing.

function chooseTarget(target) {
    state.fresh = false;
    state.target = target;
    state.reflector = null;
    state.echo = null;
    if (target >= 0) {
        state.object = objectOfTarget(target);
    }
    refresh();
}

function chooseReflector(reflector, object, echo) {
    state.fresh = false;
    state.target = -1;
    state.reflector = reflector;
    state.echo = echo || null;
    if (object !== undefined) {
        state.object = object;
    }
    refresh();
}

function chooseObject(object) {
    state.fresh = false;
    state.target = -1;
    state.reflector = null;
    state.echo = null;
    state.object = object;
    refresh();
}

function chooseNone() {
    if (state.target >= 0 || state.reflector) {
        chooseReflector(null);
    } else {
        chooseObject(-1);
    }
}

function chooseNext(step) {
    const targets = [];
    eachTarget(state.frame, (scan, target) => targets.push(target));
    if (targets.length > 0) {
        const at = targets.indexOf(state.target);
        const from = at < 0 && step < 0 ? 0 : at;
        chooseTarget(targets[(from + step + targets.length) % targets.length]);
    }
}

// Time.

function showClock() {
    const scene = head.scenes[state.scene];
    const time = scene.start_s + column('frame_time_s')[state.frame];
    const last = sceneFrames[state.scene].length;
    control('clock').textContent = `frame ${frameNumber(state.frame)} (${state.row + 1}/${last}), ${round(time, 3)} s`;
    control('scrub').value = String(state.row);
}

function showRow(row) {
    const frames = sceneFrames[state.scene];
    state.row = Math.max(0, Math.min(frames.length - 1, row));
    if (state.frame !== frames[state.row]) {
        state.target = -1;
        hideTip();
    }
    state.frame = frames.length > 0 ? frames[state.row] : -1;
    state.ego = egoBox();
    showClock();
    refresh();
}

let playedFrom = {clock: 0, time: 0};

function startClock() {
    playedFrom = {clock: performance.now(), time: column('frame_time_s')[state.frame]};
}

function playOn(now) {
    if (!state.playing) {
        return;
    }
    const frames = sceneFrames[state.scene];
    const time = playedFrom.time + state.pace * Math.max(0, now - playedFrom.clock) / 1000;
    const row = rowAt(frames, time);
    if (row !== state.row) {
        showRow(row);
    }
    if (row === frames.length - 1 &&
        (frames.length > 1 || time - playedFrom.time >= oneFrameSeconds)) {
        playFromEnd();
    } else {
        requestAnimationFrame(playOn);
    }
}

function setPlaying(playing) {
    const last = sceneFrames[state.scene].length - 1;
    if (playing && state.row === last && last > 0) {
        showRow(0);
    }
    const wasPlaying = state.playing;
    state.playing = playing && (last > 0 || sceneAfter() >= 0);
    control('play').textContent = state.playing ? '❚❚' : '▶';
    control('play').setAttribute('aria-label', state.playing ? 'Pause' : 'Play');
    panel.setAttribute('aria-live', state.playing ? 'off' : 'polite');
    if (state.playing) {
        startClock();
        if (!wasPlaying) {
            requestAnimationFrame(playOn);
        }
    }
}

function stepBy(rows) {
    setPlaying(false);
    showRow(state.row + rows);
}

// Starting.

const namesakes = new Map();
head.scenes.forEach(({name}) => namesakes.set(name, 1 + (namesakes.get(name) || 0)));

// The name of a scene, with its seed where another one has the same name.
function sceneName({name, seed}) {
    return names[name] + (namesakes.get(name) === 1 ? '' : `, seed ${seed}`);
}

function scenesCutShort() {
    return head.scenes.filter(scene => !scene.ended).map(sceneName);
}

function scenesWithHoles() {
    return head.scenes.filter((_, number) => framesMissing(number) > 0).map(sceneName);
}

function someOf(scenes) {
    const shown = scenes.slice(0, 5).map(name => `“${name}”`).join(', ');
    return `${scenes.length} of ${head.scenes.length} scenes: ${shown}` +
        (scenes.length > 5 ? ` and ${scenes.length - 5} more` : '');
}

function showNotice() {
    const alone = head.scenes.length === 1;
    const cut = scenesCutShort();
    const holes = scenesWithHoles();
    const notes = [];
    if (cut.length > 0) {
        notes.push(alone ? 'This scene ends before its last frame: the stream was cut.'
            : `Cut stream, it ends before the last frame of ${someOf(cut)}.`);
    }
    if (holes.length > 0) {
        notes.push(alone ? `${plural(framesMissing(0), 'frame')} between its first and its last are not in the stream.`
            : `Frames are missing within ${someOf(holes)}.`);
    }
    if (!hasObjects) {
        notes.push('The stream has no objects: targets are seen from the ego, wherever it is.');
    }
    control('notice').hidden = notes.length === 0;
    control('notice').textContent = notes.join(' ');
}

// Shows a scene: at a place, a row and an object, or else where it opens best.
function setScene(number, place) {
    state.scene = number;
    state.object = -1;
    state.reflector = null;
    state.echo = null;
    state.target = -1;
    control('scrub').max = String(sceneFrames[number].length - 1);
    control('scene').value = String(number);
    const open = place || openingOf(number);
    setPlaying(false);
    state.frame = -1;
    state.object = open.object;
    showRow(open.row);
    openView();
    showTimeline();
    refresh();
}

function fillScenes() {
    const choice = control('scene');
    head.scenes.forEach((scene, i) => {
        const option = make('option', sceneName(scene));
        option.value = String(i);
        choice.append(option);
    });
    control('scene-choice').hidden = head.scenes.length < 2;
    control('scene-name').textContent = head.scenes.length === 1 ? names[head.scenes[0].name] : '';
    choice.addEventListener('change', () => setScene(Number(choice.value)));
}

// Offers the effects that changed any target of the stream.
function fillEffects() {
    const found = [...new Set(effectSets.flat())].sort((a, b) => a - b);
    for (const effect of found) {
        const option = make('option', words(head.effects[effect]));
        option.value = String(effect);
        control('effect').append(option);
    }
    control('effect-choice').hidden = found.length === 0;
}

function setTheme(dark) {
    document.documentElement.classList.toggle('dark', dark);
    readInk();
    showLegend();
    if (state.frame >= 0) {
        showTimeline();
    }
    refresh();
}

// Chooses range rates as reported or over ground; each has its own scale.
function setRates(rates) {
    state.rates = rates;
    plots.rate.axes = null;
    state.fastest = fastestRate(rates === 'compensated');
    state.rateScale = Math.max(1, state.fastest);
    state.limits = plotLimits();
}

function choice(id, apply) {
    control(id).addEventListener('change', () => {
        apply(control(id).value);
        showLegend();
        refresh();
    });
}

function connectChoices() {
    choice('colour', value => { state.colour = value; });
    choice('effect', value => { state.effect = Number(value); });
    choice('rates', setRates);
    choice('up', value => { state.up = value; fitView(); });
    control('follow').addEventListener('change', () => setFollow(control('follow').checked));
    control('trail').addEventListener('change', () => {
        state.trail = control('trail').checked;
        showLegend();
        redraw();
    });
    control('pace').addEventListener('change', () => {
        state.pace = Number(control('pace').value);
        startClock();
    });
    control('scrub').addEventListener('input', () => {
        setPlaying(false);
        showRow(Number(control('scrub').value));
    });
}

function connectButtons() {
    const click = (id, act) => control(id).addEventListener('click', act);
    click('play', () => setPlaying(!state.playing));
    panel.addEventListener('pointerdown', event => {
        if (event.target.closest('button')) {
            setPlaying(false); // else the panel may replace the button before the click
        }
    });
    click('back', () => stepBy(-1));
    click('forward', () => stepBy(1));
    click('closer', () => zoomMiddle(1.4));
    click('farther', () => zoomMiddle(1 / 1.4));
    click('fit', fitView);
    click('outside', fitTargets);
    click('save', savePicture);
    click('share', copyLink);
    click('theme', () => setTheme(!isDark()));
}

function cycle(id) {
    const select = control(id);
    select.selectedIndex = (select.selectedIndex + 1) % select.options.length;
    select.dispatchEvent(new Event('change'));
}

function toggle(id) {
    control(id).click();
}

const keyActions = {
    ' ': () => setPlaying(!state.playing),
    'ArrowLeft': event => stepBy(event.shiftKey ? -10 : -1),
    'ArrowRight': event => stepBy(event.shiftKey ? 10 : 1),
    'Home': () => stepBy(-Infinity),
    'End': () => stepBy(Infinity),
    '+': () => zoomMiddle(1.25),
    '=': () => zoomMiddle(1.25),
    '-': () => zoomMiddle(0.8),
    '0': fitView,
    'a': fitTargets,
    's': savePicture,
    'k': copyLink,
    'n': () => chooseNext(1),
    'b': () => chooseNext(-1),
    'c': () => cycle('colour'),
    'e': () => cycle('effect'),
    'v': () => cycle('rates'),
    'x': () => cycle('up'),
    'f': () => toggle('follow'),
    't': () => toggle('trail'),
    'd': () => setTheme(!isDark()),
    'p': showNextPane,
    '/': () => { showPane('targets'); control('search').focus(); },
    'ArrowDown': () => chooseRow(1),
    'ArrowUp': () => chooseRow(-1),
    'o': () => sortTable((table.sort + 1) % tableColumns.length),
    'y': copyTable,
    'h': () => { control('legend').open = true; control('legend').querySelector('input').focus(); },
    'g': () => control('goto').select(),
    'l': () => setLoop(!state.loop),
    'PageDown': () => stepScene(1),
    'PageUp': () => stepScene(-1),
    '?': () => control('keys').showModal(),
    'm': enlargeNextPlot,
    'u': stepDifference,
    '.': () => stepEvent(1),
    ',': () => stepEvent(-1),
    'Escape': () => (state.large ? enlargePlot('') : chooseNone()),
};

// True if the control with the focus uses this key itself.
function isOwnKey({target, key}) {
    if (target.type === 'search' || target.type === 'text') {
        return true;
    }
    const presses = ['SELECT', 'INPUT', 'BUTTON', 'SUMMARY'].includes(target.tagName);
    const moves = target.tagName === 'SELECT' || target.type === 'range';
    return key === ' ' ? presses : moves && (key.startsWith('Arrow') || key === 'Home' || key === 'End');
}

function onKey(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || control('keys').open || isOwnKey(event)) {
        return;
    }
    const act = keyActions[event.key];
    if (act) {
        event.preventDefault();
        act(event);
    }
}

function followTheme() {
    const dark = window.matchMedia('(prefers-color-scheme: dark)');
    dark.addEventListener('change', event => setTheme(event.matches));
    document.documentElement.classList.toggle('dark', dark.matches);
    readInk();
}

// On paper the page is light.
function connectPrinting() {
    window.addEventListener('beforeprint', () => {
        const dark = isDark();
        setTheme(false);
        draw();
        window.addEventListener('afterprint', () => setTheme(dark), {once: true});
    });
}

function showEmpty() {
    control('empty').hidden = false;
    control('empty').textContent = 'The stream is empty: it has no frames.';
    for (const part of document.querySelectorAll('header label, #more, footer, aside, #legend, #zoom, #theme')) {
        part.hidden = true;
    }
}

function start() {
    followTheme();
    control('more').addEventListener('click', () => {
        const open = control('options').classList.toggle('open');
        control('more').setAttribute('aria-expanded', String(open));
    });
    control('help').addEventListener('click', () => control('keys').showModal());
    if (head.scenes.length === 0) {
        showEmpty();
        return;
    }
    fillScenes();
    fillEffects();
    connectChoices();
    connectButtons();
    connectPointers(canvas, {pan: panBy, zoom: zoomBy, click: clickAt});
    connectPlots();
    connectPanes();
    connectTable();
    connectHover();
    connectTimeline();
    connectOverTime();
    connectComparison();
    connectMerges();
    connectLinks();
    connectPrinting();
    document.addEventListener('keydown', onKey);
    new ResizeObserver(redraw).observe(canvas);
    state.amplitudes = extremes('target_amplitude_db', false);
    setRates('raw');
    showNotice();
    foldLegend();
    smallScreen.addEventListener('change', foldLegend);
    showLegend();
    followLink();
}

start();
