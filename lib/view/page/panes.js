// The panes beside the map: one is shown, and only that one is filled.

const panes = new Map([...document.querySelectorAll('#panes button')]
    .map(tab => [tab.getAttribute('aria-controls'), {tab, fill: () => {}}]));

// Symbols that the pane drew before, by their look: to make a canvas takes longer than a whole row.
const symbolPool = new Map();

function pooledSymbol(style, colour, size, kind) {
    const look = [style, colour, size, kind, isDark()].join();
    const drawn = symbolPool.get(look) || {symbols: [], used: 0};
    symbolPool.set(look, drawn);
    if (drawn.used === drawn.symbols.length) {
        drawn.symbols.push(symbolCanvas(style, colour, size, kind));
    }
    return drawn.symbols[drawn.used++];
}

function fillPane() {
    symbolPool.forEach(drawn => { drawn.used = 0; });
    panes.get(state.pane).fill();
}

function showPane(id) {
    state.pane = id;
    for (const [name, {tab}] of panes) {
        tab.setAttribute('aria-selected', String(name === id));
        tab.tabIndex = name === id ? 0 : -1;
        control(name).hidden = name !== id;
    }
    showPlots();
    refresh();
}

// The side plots lie below the panes, but for that over time, which needs the room; or one of them,
// large, over the map.
function showPlots() {
    control('plots').hidden = state.pane === 'over-time' && !state.large;
    control('plots').classList.toggle('large', state.large !== '');
    for (const kind of Object.keys(plots)) {
        plots[kind].canvas.parentElement.hidden = state.large !== '' && state.large !== kind;
        control('large-' + kind).setAttribute('aria-pressed', String(state.large === kind));
    }
    redraw();
}

function enlargePlot(kind) {
    state.large = kind;
    showPlots();
}

function enlargeNextPlot() {
    const kinds = ['', ...Object.keys(plots)];
    enlargePlot(kinds[(kinds.indexOf(state.large) + 1) % kinds.length]);
}

// On a narrow window the sentence about the frame stands below the map, else above it.
function placeSentence(narrow) {
    if (narrow) {
        document.querySelector('aside').prepend(control('sentence'));
    } else {
        document.querySelector('main').before(control('sentence'));
    }
}

function showNextPane() {
    const offered = [...panes.keys()].filter(name => !panes.get(name).tab.hidden);
    showPane(offered[(offered.indexOf(state.pane) + 1) % offered.length]);
}

function connectPanes() {
    panes.get('panel').fill = showPanel;
    const narrow = window.matchMedia('(max-width: 800px)');
    narrow.addEventListener('change', event => placeSentence(event.matches));
    placeSentence(narrow.matches);
    for (const [name, {tab}] of panes) {
        tab.addEventListener('click', () => showPane(name));
    }
    for (const kind of Object.keys(plots)) {
        control('large-' + kind).addEventListener('click', () => enlargePlot(state.large === kind ? '' : kind));
    }
    control('panes').addEventListener('keydown', event => {
        if (event.key === 'ArrowRight' || event.key === 'ArrowLeft') {
            showNextPane();
            panes.get(state.pane).tab.focus();
            event.preventDefault();
            event.stopPropagation();
        }
    });
}
