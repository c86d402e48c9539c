// The panes beside the map: one is shown, and only that one is filled.

const panes = new Map([...document.querySelectorAll('#panes button')]
    .map(tab => [tab.getAttribute('aria-controls'), {tab, fill: () => {}}]));

function fillPane() {
    panes.get(state.pane).fill();
}

function showPane(id) {
    state.pane = id;
    for (const [name, {tab}] of panes) {
        tab.setAttribute('aria-selected', String(name === id));
        tab.tabIndex = name === id ? 0 : -1;
        control(name).hidden = name !== id;
    }
    control('plots').hidden = id === 'recording';
    refresh();
}

function showNextPane() {
    const offered = [...panes.keys()].filter(name => !panes.get(name).tab.hidden);
    showPane(offered[(offered.indexOf(state.pane) + 1) % offered.length]);
}

function connectPanes() {
    panes.get('panel').fill = showPanel;
    for (const [name, {tab}] of panes) {
        tab.addEventListener('click', () => showPane(name));
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
