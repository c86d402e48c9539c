// Another stream's targets over those of this one, and a tracker's tracks over the objects, as
// glint-view --truth and --tracks put them into the page.

const hasTruth = column('frame_compared').length > 0;
const hasTracks = column('frame_tracked').length > 0;
const comparedParts = [
    {title: 'range m', name: 'range_m', digits: 2, factor: 1},
    {title: 'azim. °', name: 'azimuth_rad', digits: 2, factor: degrees},
    {title: 'rate m/s', name: 'range_rate_mps', digits: 2, factor: 1},
    {title: 'level dB', name: 'amplitude_db', digits: 1, factor: 1},
];

function truthsOf(scan) {
    const begin = starts('scan_truths');
    return {begin: begin[scan], end: begin[scan + 1]};
}

// True if both streams have this scan; only then are its targets compared.
function isScanCompared(scan) {
    return column('scan_true')[scan] === 1 && column('scan_measured')[scan] === 1;
}

// The pairs of a scan: each has the row of a true and of a listed target, or -1 for none.
function pairsOf(scan) {
    const truths = truthsOf(scan);
    const targets = targetsOf(scan);
    const pairs = [];
    const paired = new Set();
    for (let truth = truths.begin; truth < truths.end; truth++) {
        const number = column('truth_listed')[truth];
        const target = number === 0 ? -1 : targets.begin + number - 1;
        paired.add(target);
        pairs.push({scan, truth, target});
    }
    for (let target = targets.begin; target < targets.end; target++) {
        if (!paired.has(target)) {
            pairs.push({scan, truth: -1, target});
        }
    }
    return pairs;
}

function isCompared(frame) {
    return hasTruth && column('frame_compared')[frame] === 1;
}

// The scans of a frame whose sensors are switched on, if the other stream has the frame.
function scansBeside(frame) {
    return isCompared(frame) ? numbersIn(scansOf(frame)).filter(isSensorShown) : [];
}

function pairsOfFrame(frame) {
    return scansBeside(frame).filter(isScanCompared).flatMap(pairsOf);
}

// How many scans of a frame one of the streams made alone.
function countAlone(frame) {
    const alone = {truth: 0, listed: 0};
    for (const scan of scansBeside(frame)) {
        if (!isScanCompared(scan)) {
            alone.truth += column('scan_true')[scan];
            alone.listed += column('scan_measured')[scan];
        }
    }
    return alone;
}

function kindOfPair({truth, target}) {
    return truth < 0 ? 'false' : target < 0 ? 'missed' : 'matched';
}

function countKinds(pairs) {
    const counts = {matched: 0, missed: 0, false: 0};
    pairs.forEach(pair => { counts[kindOfPair(pair)]++; });
    return counts;
}

function truePlace(scan, truth) {
    return scanPlace(scan, column('truth_range_m')[truth], column('truth_azimuth_rad')[truth]);
}

// The listed value less the true one; azimuths the short way round.
function differenceOf({truth, target}, {name, factor}) {
    const apart = column('target_' + name)[target] - column('truth_' + name)[truth];
    return factor * (name === 'azimuth_rad' ? Math.atan2(Math.sin(apart), Math.cos(apart)) : apart);
}

// Drawing.

// A missed target is hollow and stands in a diamond, a false one stands in a square.
function drawAlone(drawing, at, radius, turn) {
    drawing.beginPath();
    tracePolygon(drawing, at.x, at.y, radius, 4, 0, turn);
    drawing.strokeStyle = ink.lost;
    drawing.lineWidth = 1.8;
    drawing.stroke();
}

function drawPair(pair) {
    const {scan, truth, target} = pair;
    if (truth >= 0) {
        const at = toScreen(truePlace(scan, truth));
        if (target >= 0) {
            pen.strokeStyle = ink.soft;
            pen.lineWidth = 1.5;
            line(at, toScreen(targetPlace(scan, target)));
        } else {
            drawAlone(pen, at, 14, 0);
        }
        drawTargetSymbol(pen, sensorStyle(scan), at.x, at.y, 7, ink.ink, 'truth');
    } else {
        drawAlone(pen, toScreen(targetPlace(scan, target)), 14, Math.PI / 4);
    }
}

// The tracks of a frame, and the objects that count without one, as glint-score-tracks pairs them.
function tracksOf(frame) {
    const begin = starts('frame_tracks');
    const rows = [];
    for (let i = begin[frame]; i < begin[frame + 1]; i++) {
        rows.push(i);
    }
    return rows;
}

function nameOrNone(name, i) {
    return names[column(name)[i] - 1] ?? null;
}

// The tracks of a frame whose object had another one before.
function switchesOf(frame) {
    return tracksOf(frame).filter(i => column('track_before')[i] > 0);
}

function trackPlace(i, seconds) {
    return {x: column('track_x_m')[i] + seconds * column('track_vx_mps')[i],
        y: column('track_y_m')[i] + seconds * column('track_vy_mps')[i]};
}

// Marks an object without a track.
function drawMissedObject(drawing, at, half) {
    drawing.strokeStyle = ink.lost;
    drawing.lineWidth = 2;
    drawing.setLineDash([3, 3]);
    drawing.strokeRect(at.x - half, at.y - half, 2 * half, 2 * half);
    drawing.setLineDash([]);
}

function drawTrack(i) {
    const id = nameOrNone('track_id', i);
    if (!id) {
        const row = objectRow(state.frame, column('track_object')[i] - 1);
        drawMissedObject(pen, toScreen(boxOf(row)), 11);
        return;
    }
    const at = toScreen(trackPlace(i, 0));
    const before = nameOrNone('track_before', i);
    const unpaired = column('track_excused')[i] ? ink.soft : ink.lost;
    pen.strokeStyle = nameOrNone('track_object', i) && !before ? ink.ink : unpaired;
    pen.lineWidth = 2;
    line({x: at.x - 7, y: at.y}, {x: at.x + 7, y: at.y});
    line({x: at.x, y: at.y - 7}, {x: at.x, y: at.y + 7});
    pen.lineWidth = 1.2;
    line(at, toScreen(trackPlace(i, 0.5)));
    putLabel(before ? `${id}, before ${before}` : id, at, pen.strokeStyle);
}

function drawComparison() {
    if (state.frame < 0) {
        return;
    }
    if (hasTruth) {
        pairsOfFrame(state.frame).forEach(drawPair);
    }
    tracksOf(state.frame).forEach(drawTrack);
}

function comparisonMeanings() {
    const middle = {x: 9, y: 8};
    const alone = turn => drawing => drawAlone(drawing, middle, 7, turn);
    const track = colour => lineMark(2, [[3, 8, 15, 8], [9, 2, 9, 14]], colour);
    return [
        ...hasTruth ? [
            meaning(symbolMark(0, ink.ink, 'truth'), 'true target, tied to its pair'),
            meaning(alone(0), 'missed target'),
            meaning(alone(Math.PI / 4), 'false target'),
        ] : [],
        ...hasTracks ? [
            meaning(track(ink.ink), 'track, with its id'),
            meaning(track(ink.lost), 'track of no object, or switched'),
            meaning(track(ink.soft), 'track on an object that does not count'),
            meaning(drawing => drawMissedObject(drawing, middle, 6), 'road user without a track'),
        ] : [],
    ];
}

// The pane.

function pairRow(pair) {
    const kind = kindOfPair(pair);
    const {scan, truth, target} = pair;
    const row = make('tr', null, kind);
    const mark = make('td');
    const symbol = target >= 0 ? targetSymbol(scan, target)
        : pooledSymbol(sensorStyle(scan), ink.ink, 18, 'truth');
    mark.append(symbol, target >= 0 ? ` ${target - targetsOf(scan).begin + 1}` : '');
    const object = truth >= 0 ? nameOrNone('truth_object', truth) : names[objectOfTarget(target)];
    row.append(mark, make('td', kind === 'matched' ? object : `${kind}: ${object}`));
    for (const part of comparedParts) {
        const value = kind === 'matched' ? signed(differenceOf(pair, part), part.digits)
            : round(part.factor * (truth >= 0 ? column('truth_' + part.name)[truth]
                : column('target_' + part.name)[target]), part.digits);
        row.append(make('td', value, 'number'));
    }
    if (target >= 0) {
        row.dataset.target = String(target);
        row.addEventListener('click', () => chooseTarget(target));
        row.addEventListener('pointerenter', () => setHover(target));
        row.addEventListener('pointerleave', () => setHover(-1));
    }
    return row;
}

function signed(value, digits) {
    const text = round(value, digits);
    return value > 0 && Number(text) !== 0 ? '+' + text : text;
}

function pairsTable(pairs) {
    const table = make('table');
    table.append(tableRow(['', '', ...comparedParts.map(part => part.title)], 'th'));
    const order = ['missed', 'false', 'matched'];
    const sorted = [...pairs].sort((a, b) => order.indexOf(kindOfPair(a)) - order.indexOf(kindOfPair(b)));
    table.append(...sorted.slice(0, 120).map(pairRow));
    return [table, ...moreLine(sorted.length - 120)];
}

let totals = {scene: -1};

// Counts over all frames of the scene, and the root mean squares of the differences.
function comparisonTotals() {
    if (totals.scene !== state.scene) {
        totals = {scene: state.scene, counts: {matched: 0, missed: 0, false: 0}, alone: {truth: 0, listed: 0},
            squares: [0, 0, 0, 0], switches: 0};
        for (const frame of sceneFrames[state.scene]) {
            addToTotals(frame);
        }
    }
    return totals;
}

function addToTotals(frame) {
    for (const pair of pairsOfFrame(frame)) {
        const kind = kindOfPair(pair);
        totals.counts[kind]++;
        if (kind === 'matched') {
            comparedParts.forEach((part, i) => { totals.squares[i] += differenceOf(pair, part) ** 2; });
        }
    }
    const {truth, listed} = countAlone(frame);
    totals.alone.truth += truth;
    totals.alone.listed += listed;
    totals.switches += switchesOf(frame).length;
}

function kindsText({matched, missed, false: wrong}) {
    return `${matched} matched, ${missed} missed, ${wrong} false`;
}

// Scans that are not compared, as only one of the streams made them; nothing if there are none.
function aloneLine({truth, listed}) {
    const text = [[truth, 'of the other stream alone'], [listed, 'of this stream alone']]
        .filter(([count]) => count > 0).map(([count, whose]) => `${plural(count, 'scan')} ${whose}`).join(', ');
    return text ? [make('p', `Not compared: ${text}.`, 'soft')] : [];
}

function comparedTargets() {
    if (!isCompared(state.frame)) {
        return [make('p', 'The other stream has no such frame.', 'soft')];
    }
    const pairs = pairsOfFrame(state.frame);
    const {counts, alone, squares} = comparisonTotals();
    const errors = comparedParts.map((part, i) =>
        `${round(Math.sqrt(squares[i] / Math.max(1, counts.matched)), 2)} ${part.title.split(' ')[1]}`);
    return [
        make('p', `In this frame ${kindsText(countKinds(pairs))}.`),
        ...aloneLine(countAlone(state.frame)),
        make('p', `In the whole scene ${kindsText(counts)}; matched ones differ by ${errors.join(', ')} (RMS).`, 'soft'),
        ...aloneLine(alone),
        ...pairsTable(pairs)];
}

function trackRow(i) {
    const id = nameOrNone('track_id', i);
    const object = nameOrNone('track_object', i);
    const before = nameOrNone('track_before', i);
    const unpaired = column('track_excused')[i] ? 'does not count' : 'of no object';
    const row = make('tr');
    row.append(make('td', id || 'missed'), make('td', object || unpaired),
        make('td', id && object ? `${round(column('track_apart_m')[i], 2)} m` : '', 'number'),
        make('td', before ? `before ${before}` : '', 'switch'));
    return row;
}

function comparedTracks() {
    if (!column('frame_tracked')[state.frame]) {
        return [make('p', 'The tracks have no such frame.', 'soft')];
    }
    const table = make('table');
    const titles = make('tr');
    titles.append(make('th', 'track'), make('th', 'object'), make('th', 'apart', 'number'), make('th'));
    table.append(titles, ...tracksOf(state.frame).map(trackRow));
    return [make('p', `Identity switches in the whole scene: ${comparisonTotals().switches}.`), table];
}

function fillComparison() {
    control('comparison').replaceChildren(
        ...hasTruth ? [make('h2', 'Beside the other stream'), ...comparedTargets()] : [],
        ...hasTracks ? [make('h2', 'Tracks'), ...comparedTracks()] : []);
}

// What a frame has missed, false or switched, as events.
function differencesOf(frame) {
    const targets = pairsOfFrame(frame).filter(pair => kindOfPair(pair) !== 'matched')
        .map(pair => ({target: pair.target, object: -1, missed: pair.target < 0 ? pair : null}));
    return targets.concat(switchesOf(frame).map(i => ({target: -1, object: column('track_object')[i] - 1})));
}

function connectComparison() {
    panes.get('comparison').fill = fillComparison;
    panes.get('comparison').tab.hidden = !hasTruth && !hasTracks;
}
