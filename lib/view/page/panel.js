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

// A number with so many digits; a dash for none.
function round(value, digits) {
    return value === null ? '–' : value.toFixed(digits).replace(/^-(0(\.0*)?)$/, '$1');
}

// A share in per cent with these decimals, or with as many more as it takes to differ from none and all.
function percent(share, digits = 0) {
    for (let more = digits; more <= 3; more++) {
        const told = round(100 * share, more);
        if (Number(told) % 100 !== 0) {
            return `${told} %`;
        }
    }
    return share > 0 && share < 0.5 ? 'under 0.001 %' : `${round(100 * share, digits)} %`;
}

function plural(count, word) {
    return `${count} ${word}${count === 1 ? '' : 's'}`;
}

function words(name) {
    return name.replace(/_/g, ' ');
}

const otherPaths = {
    wheel: 'a point of a turning wheel',
    limb: 'an arm or a leg',
    clutter: 'the ground or roadside',
    false_alarm: 'nothing but noise',
};

// The path of an echo in words: "direct", or a ghost's legs from the radar and back.
function pathWords(path, mirror, number) {
    const name = head.paths[path];
    const stops = {wall: mirror > 0 ? names[mirror - 1] : 'a wall', object: 'it'};
    const way = isGhostPath(path)
        ? `ghost: radar → ${name.split('_').map(stop => stops[stop]).join(' → ')} → radar`
        : otherPaths[name] || words(name);
    return number > 0 ? `${way}, no. ${number}` : way;
}

const ghostWays = {wall_object: 'out by', object_wall: 'back by', wall_object_wall: 'out and back by'};

// The reflector of an echo and its path in few words: "corner_rl by wheel 2", "ghost of corner_rl out by
// wall". Direct paths are named only in streams where bodies also have other paths.
function echoWords(reflector, {path, mirror, number}) {
    const name = head.paths[path];
    const wall = mirror > 0 ? names[mirror - 1] : 'a wall';
    const note = isGhostPath(path) ? ` ${ghostWays[name]} ${wall}`
        : name === 'wheel' || name === 'limb' ? ` by ${name} ${number}`
            : name === 'direct' && bodyPaths > 1 ? ' direct' : '';
    return (isGhostPath(path) ? 'ghost of ' : '') + names[reflector] + note;
}

function contributorWords(i) {
    return echoWords(column('contributor_reflector')[i], echoOfContributor(i));
}

function contributorPath(i) {
    return pathWords(column('contributor_path')[i], column('contributor_mirror')[i],
        column('contributor_number')[i]);
}

function targetSymbol(scan, target) {
    return pooledSymbol(sensorStyle(scan), colourOf(scan, target), 18, kindOf(target));
}

function shortReason(loss) {
    switch (loss.reason.name) {
    case 'below_threshold': return `${round(loss.shortfall, 1)} dB too weak`;
    case 'below_final_threshold': return `${round(loss.shortfall, 1)} dB too weak after noise`;
    case 'blocked': return `blocked by ${loss.by}`;
    case 'list_limit': return 'the list was full';
    case 'no_angle': return 'no angle';
    case 'no_amplitude': return 'in a null of the antenna';
    default: return words(loss.reason.name);
    }
}

function longReason(loss) {
    switch (loss.reason.name) {
    case 'facing_away': return 'It faces away: the sensor is outside its range of visibility.';
    case 'no_specular_point': return 'It is a flat side, and mirrors the radar past the sensor.';
    case 'out_of_range': return 'It is nearer or farther than the sensor measures.';
    case 'out_of_view': return 'It is outside the sensor’s field of view.';
    case 'blocked': return `${loss.by} stands in the way.`;
    case 'no_amplitude': return 'Nothing comes back: the antenna has a null there.';
    case 'below_threshold':
        return `All echoes in its cell together are ${round(loss.shortfall, 2)} dB below the detection threshold.`;
    case 'below_final_threshold':
        return `After superposition and noise its cell is ${round(loss.shortfall, 2)} dB below the threshold.`;
    case 'no_angle': return 'Both channels of its cell are exactly zero, so there is no angle.';
    case 'list_limit': return 'The sensor reports no more targets than it did already.';
    case 'switched_off': return 'The effect that would have made its echo is not selected.';
    default: return capital(ownReason(loss)) + '.';
    }
}

// A stage's own reason without the stage, for places that name it.
function ownReason({reason, stage}) {
    return words(reason.name.replace(`${stage}: `, ''));
}

function effectNote(effect) {
    return effect ? ` (${words(effect)})` : '';
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

function silentWords(reason) {
    return reason === 'no_specular_point' ? 'mirroring past the sensor' : words(reason);
}

// Share in view, in the levels of nuScenes, by number (lib/frame/sightings.h).
const levels = ['0 to 40 %', '40 to 60 %', '60 to 80 %', '80 to 100 %'];

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

function sightingWords(i) {
    const value = name => column('sighting_' + name)[i];
    const inView = value('in_view');
    const seen = `${value('in_range')} of ${plural(value('reflectors'), 'reflection centre')} in range, ${inView} in view`;
    const hidden = inView > 0
        ? `, ${percent(value('blocked_share'))} of these blocked (visibility ${levels[value('visibility')]})` : '';
    const merged = value('merged') > 0 ? `, ${value('merged')} merged with something else` : '';
    const ghosts = value('ghosts') > 0 ? `, ${plural(value('ghosts'), 'ghost')}` : '';
    return `${seen}${hidden}. ${plural(value('detections'), 'detection')}${merged}${ghosts}.`;
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
    const row = objectRow(state.frame, state.object);
    const parts = [make('h2', objectTitle(state.object))];
    parts.push(...objectNotes().map(note => make('p', note, 'soft')));
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; scan < end && state.object !== head.scenes[state.scene].ego; scan++) {
        parts.push(...objectBlocks(scan));
    }
    panel.replaceChildren(...parts);
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

function valuesTable(scan, target) {
    const table = make('table', null, 'values');
    const value = name => column(name)[target];
    const sum = value('target_cell_sum');
    const ground = rateOf(scan, target, true);
    const elevations = ['elevation_reported_rad', 'elevation_cell_rad'].map(name => elevationOf(target, name, 2));
    const unknown = isRateFolded(scan, target) ? 'folded: not known' : 'not known';
    table.append(
        tableRow(['', 'reported', 'without noise'], 'th'),
        tableRow(['range', `${round(value('target_range_m'), 3)} m`,
            `${round(value('target_cell_range_m'), 3)} m`]),
        tableRow(['azimuth off boresight', `${round(value('target_azimuth_rad') * degrees, 2)}°`,
            `${round(value('target_cell_azimuth_rad') * degrees, 2)}°`]),
        ...elevations[0] ? [tableRow(['elevation', ...elevations])] : [],
        tableRow(['range rate', `${round(value('target_range_rate_mps'), 3)} m/s`,
            `${round(value('target_cell_range_rate_mps'), 3)} m/s`]),
        tableRow(['… over ground', ground === null ? unknown : `${round(ground, 3)} m/s`, '']),
        tableRow(['amplitude', `${round(value('target_amplitude_db'), 2)} dB`,
            sum > 0 ? `${round(20 * Math.log10(sum), 2)} dB` : '']));
    return table;
}

// A target's quality as rows of a table; none if the stream has no quality.
function qualityRows(target) {
    const begin = starts('target_quality');
    const row = begin[target];
    if (begin[target + 1] === row) {
        return [];
    }
    const value = name => column('quality_' + name)[row];
    const number = (name, digits, unit, scale = 1) => Number.isNaN(value(name)) ? 'not known'
        : `${round(scale * value(name), digits)}${unit}`;
    const place = (x, y) => Number.isNaN(value(x)) ? 'not known'
        : `${round(value(x), 2)}, ${round(value(y), 2)} m`;
    const merged = value('merged_objects') ? 'several objects'
        : value('merged_reflectors') ? 'several reflection centres' : 'no';
    const folds = Number.isNaN(value('ambiguity_number')) ? []
        : [['label: true rate is off by', `${value('ambiguity_number')} times ${number('range_rate_interval_mps', 2, ' m/s')}`]];
    return [
        ['signal over noise', number('snr_db', 1, ' dB')],
        ['cross section', number('rcs_dbsm', 1, ' dBsm')],
        ['deviation of range', number('range_sd_m', 3, ' m')],
        ['… of azimuth', number('azimuth_sd_rad', 2, '°', degrees)],
        ...Number.isNaN(value('elevation_sd_rad')) ? [] : [['… of elevation', number('elevation_sd_rad', 2, '°', degrees)]],
        ['… of range rate', number('range_rate_sd_mps', 3, ' m/s')],
        ['exists with', Number.isNaN(value('existence')) ? 'not known' : percent(value('existence'), 1)],
        ['rate less the sensor’s own', number('range_rate_over_ground_mps', 3, ' m/s')],
        ...folds,
        ['channels show several echoes', Number.isNaN(value('looks_merged')) ? 'not known' : value('looks_merged') ? 'yes' : 'no'],
        ['label: merged', merged],
        ['from the sensor', place('x_sensor_m', 'y_sensor_m')],
        ['from the ego’s centre', place('x_centre_m', 'y_centre_m')],
        ['from the rear axle', place('x_rear_axle_m', 'y_rear_axle_m')],
        ['in the world', place('x_world_m', 'y_world_m')],
    ];
}

function qualityBlock(target) {
    const rows = qualityRows(target);
    const table = make('table', null, 'values');
    table.id = 'quality';
    table.append(...rows.map(row => tableRow(row)));
    return block('Quality', rows.length === 0 ? [] : [table]);
}

function weightBar(weight, colour) {
    const bar = make('div', null, 'bar');
    const filled = make('div');
    filled.style.width = 100 * weight + '%';
    filled.style.background = colour;
    bar.append(filled);
    return bar;
}

// What tells a contributor from other echoes of its reflector.
function echoOfContributor(i) {
    const value = name => column('contributor_' + name)[i];
    return {path: value('path'), mirror: value('mirror'), number: value('number')};
}

function contributorRow(scan, target, i) {
    const value = name => column('contributor_' + name)[i];
    const object = value('object');
    const reflector = names[value('reflector')];
    const text = make('span');
    text.append(make('b', reflector), ` of ${names[object]}, ${contributorPath(i)}`,
        weightBar(value('weight'), colourOf(scan, target)),
        make('span', `${round(value('range_m'), 3)} m, ${round(value('azimuth_rad') * degrees, 2)}°, ` +
            `${round(value('range_rate_mps'), 3)} m/s, ERCS ${Number(value('ercs').toPrecision(3))}`, 'soft'));
    return rowButton('●', [text], percent(value('weight'), 1),
        () => chooseReflector(reflector, object, echoOfContributor(i)));
}

function backButton() {
    const back = button('', () => chooseTarget(-1));
    back.textContent = '‹ all of this object';
    return back;
}

const kindTitles = {ghost: ', a ghost', clutter: ', clutter', false_alarm: ', a false alarm', body: ''};

function showTarget() {
    const scan = scanOfTarget(state.frame, state.target);
    const {begin, end} = contributorsOf(state.target);
    const number = state.target - targetsOf(scan).begin + 1;
    const title = make('h2');
    title.append(targetSymbol(scan, state.target),
        ` Target ${number} of ${sensorOf(scan).name}${kindTitles[kindOf(state.target)]}`);
    const order = Array.from({length: end - begin}, (_, i) => begin + i);
    const weights = column('contributor_weight');
    order.sort((a, b) => weights[b] - weights[a]);
    const rows = order.slice(0, 40).map(i => contributorRow(scan, state.target, i));
    panel.replaceChildren(backButton(), title, valuesTable(scan, state.target),
        ...targetNotes(scan), ...block(`Made of ${plural(order.length, 'reflection centre')}`, rows),
        ...moreLine(order.length - rows.length), ...apartBlock(scan, state.target),
        make('p', cellWords(cellOf(scan)), 'soft'), ...qualityBlock(state.target));
}

// The resolution cell that is drawn around a chosen target.
function cellWords(cell) {
    if (!cell) {
        return 'The stream does not tell the size of the radar’s cell.';
    }
    return `The radar’s cell: ${metres(cell.range_m)} m (dashed arcs on the map) by ` +
        `${metres(cell.range_rate_mps)} m/s (a box in range over rate, if enlarged enough). Echoes within half ` +
        'of it of a stronger one, in both, become one target with it, unless an array tells their angles apart.';
}

function targetNotes(scan) {
    const notes = [];
    const effects = effectsOf(state.target).map(effect => words(head.effects[effect]));
    if (effects.length > 0) {
        notes.push(make('p', `Effects that changed it: ${effects.join(', ')}.`, 'soft'));
    }
    notes.push(...foldedNotes(scan).map(note => make('p', note)));
    if (isInterfered(state.target)) {
        notes.push(make('p', 'Other radars raised the noise here: interference.', 'soft'));
    }
    if (column('target_sign_undecided')[state.target]) {
        notes.push(make('p', 'Left or right is undecided: the phase did not tell.', 'soft'));
    }
    const age = column('scan_age_s')[scan];
    if (age > 1e-6) {
        notes.push(make('p', `Measured ${round(1000 * age, 1)} ms before the frame's time.`, 'soft'));
    }
    return notes;
}

// Notes on folded values: as reported, and the true ones.
function foldedNotes(scan) {
    const notes = [];
    const note = (what, name, unit, digits) => notes.push(`Its ${what} is folded: reported ` +
        `${round(column('target_' + name)[state.target], digits)} ${unit}, in truth ` +
        `${round(exactValue(name, state.target), digits)} ${unit}, which the radar cannot tell apart.`);
    if (isRateFolded(scan, state.target)) {
        note('range rate', 'range_rate_mps', 'm/s', 2);
    }
    if (isRangeFolded(scan, state.target)) {
        note('range', 'range_m', 'm', 2);
    }
    return notes;
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
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; scan < end; scan++) {
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
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; scan < end; scan++) {
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
