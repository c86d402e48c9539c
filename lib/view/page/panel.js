// The panel: a description of what is chosen on the map. Names enter the page as text only, never
// as HTML.

const panel = document.getElementById('panel');

function make(tag, text, className) {
    const element = document.createElement(tag);
    if (text !== undefined && text !== null) {
        element.textContent = text;
    }
    if (className) {
        element.className = className;
    }
    return element;
}

function symbolCanvas(style, colour, size, kind) {
    const small = make('canvas');
    paintSymbol(small, style, colour, size, kind);
    return small;
}

function paintSymbol(small, style, colour, size, kind) {
    const ratio = window.devicePixelRatio || 1;
    small.width = small.height = Math.round(size * ratio);
    small.style.width = small.style.height = size + 'px';
    const drawing = small.getContext('2d');
    drawing.scale(ratio, ratio);
    drawTargetSymbol(drawing, style, size / 2, size / 2, size * 0.36, colour, kind);
}

function targetSymbol(scan, target) {
    return pooledSymbol(sensorStyle(scan), colourOf(scan, target), 18, kindOf(target));
}

function button(className, onClick) {
    const element = make('button', null, className);
    element.addEventListener('click', onClick);
    return element;
}

function rowButton(mark, what, value, onClick) {
    const row = button('row', onClick);
    const left = make('span', null, 'mark');
    left.append(mark);
    const middle = make('span', null, 'what');
    middle.append(...what);
    row.append(left, middle, make('span', value, 'value'));
    return row;
}

function partsText(target, object) {
    const {begin, end} = contributorsOf(target);
    const parts = [];
    for (let i = begin; i < end; i++) {
        const foreign = column('contributor_object')[i] !== object;
        parts.push({
            weight: column('contributor_weight')[i],
            text: contributorWords(i) + (foreign ? ` of ${names[column('contributor_object')[i]]}` : ''),
        });
    }
    parts.sort((a, b) => b.weight - a.weight);
    const shown = parts.slice(0, parts.length > 5 ? 4 : 5); // a contour has hundreds
    return shown.map(part => `${part.text} ${percent(part.weight)}`).join(' + ') +
        (parts.length > shown.length ? ` and ${parts.length - shown.length} more` : '');
}

// A target in a list; before is the target of the same object above it, if any.
function targetRow(scan, target, number, object, before) {
    const label = make('b', `${number} `);
    const level = `${round(column('target_amplitude_db')[target], 1)} dB`;
    const apart = before && cellOf(scan) ? [apartLine(scan, target, before)] : [];
    return rowButton(targetSymbol(scan, target), [label, partsText(target, object), ...apart], level, () => chooseTarget(target));
}

function lossRow(loss) {
    const row = rowButton('✕', [make('b', echoWords(loss.reflector, loss)), ` ${shortReason(loss)}`],
        loss.effect ? words(loss.effect) : '',
        () => chooseReflector(names[loss.reflector], loss.object, loss));
    row.classList.add('lost');
    return row;
}

function silentBlock(losses) {
    const groups = new Map();
    for (const loss of losses) {
        const what = silentWords(loss.reason.name) + effectNote(loss.effect);
        groups.set(what, (groups.get(what) || []).concat(head.paths[loss.path] === 'direct' ? names[loss.reflector] : echoWords(loss.reflector, loss)));
    }
    const lines = [];
    for (const [what, reflectors] of groups) {
        const line = make('p', null, 'soft');
        reflectors.sort();
        const more = reflectors.length > 12 ? ` and ${reflectors.length - 12} more` : '';
        line.append(make('b', `${reflectors.length} ${what}: `),
            reflectors.slice(0, 12).join(', ') + more);
        lines.push(line);
    }
    return lines;
}

// The visibility of the chosen object, as --sections visibility gives it: a line, or none.
function sightingLines(scan) {
    const begin = starts('scan_sightings');
    const objects = column('sighting_object');
    for (let i = begin[scan]; i < begin[scan + 1]; i++) {
        if (objects[i] === state.object) {
            return [make('p', sightingWords(i), 'soft')];
        }
    }
    return [];
}

function summary(scan, targets, notable, silent) {
    if (!column('scan_measured')[scan]) {
        return 'did not measure in this frame';
    }
    const parts = [plural(targets.length, 'target')];
    if (notable.length > 0) {
        parts.push(notable.length === 1 ? '1 echo lost' : `${notable.length} echoes lost`);
    }
    if (silent.length > 0) {
        parts.push(`${silent.length} sent no echo`);
    }
    return parts.join(', ');
}

function sensorTitle(scan, text) {
    const title = make('h3');
    const style = sensorStyle(scan);
    const name = make('b', sensorOf(scan).name);
    title.append(pooledSymbol(style, sensorColour(style), 16), ' ', name, text ? `: ${text}` : '');
    return title;
}

function moreLine(count) {
    return count > 0 ? [make('p', `and ${count} more`, 'soft')] : [];
}

function block(title, rows) {
    return rows.length === 0 ? [] : [make('h3', title), ...rows];
}

function objectTitle(id) {
    const row = objectRow(state.frame, id);
    const kind = !hasObjects ? names[id] : row < 0 ? 'not in this frame' : names[column('object_class')[row]];
    return kind === names[id] ? kind : `${names[id]} (${kind})`;
}

function objectNotes() {
    if (state.object === head.scenes[state.scene].ego) {
        return ['The ego carries the sensors. It neither reflects nor blocks.'];
    }
    const notes = state.fresh ? ['Click a target to see what it is made of.'] : [];
    if (!column('frame_account')[state.frame] && hasSensors()) {
        notes.push('The frame does not tell what was lost: give --sections account to glint-ideal.');
    }
    return notes;
}

function hasSensors() {
    const {begin, end} = scansOf(state.frame);
    return end > begin;
}

function showObject() {
    const isEgo = state.object === head.scenes[state.scene].ego;
    const scans = isEgo ? [] : numbersIn(scansOf(state.frame));
    panel.replaceChildren(make('h2', objectTitle(state.object)),
        ...objectNotes().map(note => make('p', note, 'soft')), ...scans.flatMap(objectBlocks));
}

function objectBlocks(scan) {
    const targets = targetsFrom(scan, state.object);
    const losses = lossesOf(scan, state.object);
    const notable = losses.filter(loss => loss.reason.notable);
    const silent = losses.filter(loss => !loss.reason.notable);
    return [
        sensorTitle(scan, summary(scan, targets, notable, silent)),
        ...sightingLines(scan),
        ...targets.map((one, i) => targetRow(scan, one.target, one.number, state.object, targets[i - 1])),
        ...notable.slice(0, 40).map(lossRow),
        ...moreLine(notable.length - 40),
        ...silentBlock(silent),
    ];
}

function tableRow(cells, tag) {
    const row = make('tr');
    cells.forEach((cell, i) => row.append(make(tag || (i ? 'td' : 'th'), cell, i ? 'number' : '')));
    return row;
}

function backButton() {
    const back = button('', () => chooseTarget(-1));
    back.textContent = '‹ all of this object';
    return back;
}

// Does the panel tell of an echo? Of many that are alike, only of the one that was clicked.
function isListedEcho(object, reflector, number) {
    return object === state.object && names[reflector] === state.reflector &&
        (state.echo === null || state.echo.number === 0 || state.echo.number === number);
}

// What became of the echoes of the chosen reflection centre in a scan.
function reflectorFates(scan) {
    const fates = [];
    for (const {target, number} of targetsFrom(scan, state.object)) {
        const {begin, end} = contributorsOf(target);
        for (let i = begin; i < end; i++) {
            if (isListedEcho(column('contributor_object')[i], column('contributor_reflector')[i],
                column('contributor_number')[i])) {
                const weight = percent(column('contributor_weight')[i], 1);
                fates.push(rowButton(targetSymbol(scan, target),
                    [`In target ${number}, with ${weight} of its weight, ${contributorPath(i)}.`], '',
                    () => chooseTarget(target)));
            }
        }
    }
    for (const loss of lossesOf(scan, state.object)) {
        if (isListedEcho(state.object, loss.reflector, loss.number)) {
            const line = make('p');
            line.append(make('b', `Lost in ${loss.stage}, ${pathWords(loss.path, loss.mirror, loss.number)}. `),
                longReason(loss) + effectNote(loss.effect));
            fates.push(line);
        }
    }
    return fates;
}

function showReflector() {
    const parts = [backButton(), make('h2', `${state.reflector} of ${objectTitle(state.object)}`)];
    for (const scan of numbersIn(scansOf(state.frame))) {
        const fates = reflectorFates(scan);
        const silent = !column('scan_measured')[scan] ? 'The sensor did not measure in this frame.'
            : column('frame_account')[state.frame] ? 'The frame has no echo of it, neither in a target nor lost.'
                : 'In no target. Why is not in the frame: give --sections account to glint-ideal.';
        parts.push(sensorTitle(scan, fates.length > 1 ? `${fates.length} echoes` : ''),
            ...(fates.length > 0 ? fates : [make('p', silent)]));
    }
    panel.replaceChildren(...parts);
}

// The losses of the frame by reason; a click draws them on the map, or no longer.
function causeBlock() {
    const rows = frameCauses(state.frame).map(({item, count}) => {
        const shown = state.cause === causeOf(item);
        const row = rowButton('✕', [make('b', String(count)), ` ${item.reason.name === 'no_specular_point' ? silentWords(item.reason.name) : ownReason(item)}`],
            `in ${item.stage}`, () => showCause(shown ? null : causeOf(item)));
        row.setAttribute('aria-pressed', String(shown));
        row.classList.toggle('chosen', shown);
        row.classList.add(item.reason.notable ? 'lost' : 'silent');
        return row;
    });
    return block('Echoes that are in no target, by reason: click to draw them', rows);
}

function showCause(cause) {
    state.cause = cause;
    refresh();
    if (cause !== null && !placesOfCause().some(place => onScreen(toScreen(place), 0))) {
        fitView();
    }
}

// The road users of the frame that are in no target; a click tells why.
function silentObjects() {
    const seen = new Set([head.scenes[state.scene].ego]);
    eachTarget(state.frame, (scan, target) => eachObjectOf(target, object => seen.add(object)));
    const {begin, end} = objectsOf(state.frame);
    const silent = [...column('object_id').slice(begin, end)]
        .filter((object, i) => !seen.has(object) && isRoadUser(begin + i));
    const rows = silent.slice(0, 24).map(object =>
        rowButton('–', [objectTitle(object)], '', () => chooseObject(object)));
    return block('Road users without a target: click to see why', rows).concat(moreLine(silent.length - rows.length));
}

function showFrame() {
    const parts = [make('h2', 'This frame')];
    parts.push(make('p', hasSensors() ? 'Click a target, a reflection centre or an object.'
        : 'The stream has no sensors: only the scene is shown.', 'soft'));
    if (hasSensors() && column('target_range_m').length === 0) {
        parts.push(make('p', 'No frame of this stream has a target: has it been through all stages?', 'soft'));
    }
    parts.push(...causeBlock());
    for (const scan of numbersIn(scansOf(state.frame))) {
        const targets = targetsOf(scan);
        const count = targets.end - targets.begin;
        parts.push(sensorTitle(scan, summary(scan, {length: count}, [], [])));
        for (let i = 0; i < Math.min(count, 300); i++) {
            const target = targets.begin + i;
            parts.push(targetRow(scan, target, i + 1, -1));
        }
        parts.push(...moreLine(count - 300));
    }
    parts.push(...(hasSensors() ? silentObjects() : []));
    panel.replaceChildren(...parts);
}

// Fills the panel; the keyboard's focus stays in it if it was there.
function showPanel() {
    const walking = panel.querySelector(':focus-visible') !== null;
    fillPanel();
    if (walking) {
        (panel.querySelector('button') || canvas).focus({preventScroll: true});
    }
}

function fillPanel() {
    if (state.frame < 0) {
        panel.replaceChildren();
    } else if (state.target >= 0) {
        showTarget();
    } else if (state.reflector) {
        showReflector();
    } else if (state.object >= 0) {
        showObject();
    } else {
        showFrame();
    }
}
