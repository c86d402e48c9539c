// The view as a link: #scene=&frame=&object=&colour= names what is shown, and opening such a link,
// or loading the page again, shows it.

let written = null; // the part of the address that the page wrote itself
let writing = 0;

function linkText() {
    const parts = new URLSearchParams();
    parts.set('scene', sceneName(head.scenes[state.scene]));
    parts.set('frame', String(frameNumber(state.frame)));
    parts.set('object', state.object < 0 ? '' : names[state.object]);
    parts.set('colour', state.colour);
    return '#' + parts;
}

// Writes the address soon, once for many changes.
function rememberPlace() {
    clearTimeout(writing);
    writing = setTimeout(() => {
        written = linkText();
        window.history.replaceState(null, '', written);
    }, 200);
}

// What the address asks for: scene, row and object by number, as far as the stream has them.
function placeOfLink() {
    const parts = new URLSearchParams(location.hash.slice(1));
    const named = head.scenes.findIndex(scene => sceneName(scene) === parts.get('scene'));
    const scene = Math.max(0, named);
    const row = !parts.get('frame') ? -1
        : sceneFrames[scene].findIndex(frame => frameNumber(frame) === Number(parts.get('frame')));
    return {scene, place: row < 0 ? null : {row, object: names.indexOf(parts.get('object') || undefined)}};
}

function followLink() {
    const colour = new URLSearchParams(location.hash.slice(1)).get('colour');
    if ([...control('colour').options].some(option => option.value === colour)) {
        control('colour').value = state.colour = colour;
        showLegend();
    }
    const {scene, place} = placeOfLink();
    setScene(scene, place);
}

function connectLinks() {
    window.addEventListener('hashchange', () => {
        if (location.hash !== written) {
            followLink();
        }
    });
}
