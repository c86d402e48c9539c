// Echoes that are in no target, and the places of all: as the stream has them, at the instant of the
// measurement.

// The rows of the spots of each object's reflectors, by scene and object.
const spotRows = new Map();

function indexSpots() {
    const objects = column('spot_object');
    for (let row = 0; row < objects.length; row++) {
        const key = `${column('spot_scene')[row]}/${objects[row]}`;
        if (!spotRows.has(key)) {
            spotRows.set(key, new Map());
        }
        spotRows.get(key).set(column('spot_reflector')[row], row);
    }
}

// The spots of an object of the scene: by the number of the reflector's name, their row.
function spotsOf(object) {
    if (spotRows.size === 0) {
        indexSpots();
    }
    return spotRows.get(`${state.scene}/${object}`) || new Map();
}

function spotPlace(box, spot) {
    const ahead = column('spot_x_m')[spot];
    const left = column('spot_y_m')[spot];
    return {
        x: box.x + ahead * box.cos - left * box.sin,
        y: box.y + ahead * box.sin + left * box.cos,
    };
}

// An object's box at the instant that a scan shows.
function measuredBox(scan, row) {
    return boxBefore(boxOf(row), column('scan_age_s')[scan]);
}

function echoKey(object, {reflector, path, mirror, number}) {
    return `${object}/${reflector}/${path}/${mirror}/${number}`;
}

// The rows of a scan's details by echo, kept for the scans of one frame.
const detailRows = {frame: -1, scans: new Map()};

function detailRowsOf(scan) {
    if (detailRows.frame !== state.frame) {
        detailRows.frame = state.frame;
        detailRows.scans.clear();
    }
    let rows = detailRows.scans.get(scan);
    if (rows === undefined) {
        rows = new Map();
        const {begin, end} = detailsOf(scan);
        for (let i = begin; i < end; i++) {
            const value = name => column('detail_' + name)[i];
            rows.set(echoKey(value('object'), {reflector: value('reflector'), path: value('path'),
                mirror: value('mirror'), number: value('number')}), i);
        }
        detailRows.scans.set(scan, rows);
    }
    return rows;
}

// What is known of one lost echo besides its reason: who blocked it, how many dB it lacked, and where
// it was, with range 0 if it was at its spot.
function detailFor(scan, object, item) {
    const i = detailRowsOf(scan).get(echoKey(object, item));
    if (i === undefined) {
        return {by: null, shortfall: 0, range: 0, azimuth: 0};
    }
    const by = column('detail_by')[i];
    return {
        by: by > 0 ? names[by - 1] : null,
        shortfall: column('detail_shortfall_db')[i],
        range: column('detail_range_m')[i],
        azimuth: column('detail_azimuth_rad')[i],
    };
}

function patternItems(pattern) {
    const begin = starts('pattern_items');
    const items = [];
    for (let i = begin[pattern]; i < begin[pattern + 1]; i++) {
        items.push({
            reflector: column('item_reflector')[i],
            path: column('item_path')[i],
            mirror: column('item_mirror')[i],
            number: column('item_number')[i],
            stage: names[column('item_stage')[i]],
            reason: head.reasons[column('item_reason')[i]],
            effect: head.effects[column('item_effect')[i]],
        });
    }
    return items;
}

// Calls visit with the object and the pattern of each fate of a scan.
function eachFate(scan, visit) {
    const begin = starts('scan_fates');
    const objects = column('fate_object');
    const patterns = column('fate_pattern');
    for (let i = begin[scan]; i < begin[scan + 1]; i++) {
        visit(objects[i], patterns[i]);
    }
}

// Every echo of an object that a scan lost, with the reason.
function lossesOf(scan, object) {
    let losses = [];
    eachFate(scan, (owner, pattern) => {
        if (owner === object) {
            losses = patternItems(pattern).map(item =>
                ({...item, object, ...detailFor(scan, object, item)}));
        }
    });
    return losses;
}

// The place of an echo that a scan lost; null if the stream has none. Ghosts are not at their reflector.
function lossPlace(scan, loss) {
    if (loss.range > 0) {
        return scanPlace(scan, loss.range, loss.azimuth);
    }
    if (head.kinds[loss.path] !== 'body') {
        return null;
    }
    const row = objectRow(state.frame, loss.object);
    const spot = spotsOf(loss.object).get(loss.reflector);
    return row < 0 || spot === undefined ? null : spotPlace(measuredBox(scan, row), spot);
}

function causeOf(item) {
    return `${item.stage}/${item.reason.name}`;
}

const patternCauses = new Map();

// How many echoes of a pattern each stage lost for each reason.
function causesOf(pattern) {
    let causes = patternCauses.get(pattern);
    if (causes === undefined) {
        causes = new Map();
        for (const item of patternItems(pattern)) {
            const known = causes.get(causeOf(item)) || {item, count: 0};
            known.count++;
            causes.set(causeOf(item), known);
        }
        patternCauses.set(pattern, causes);
    }
    return causes;
}

// The losses of a whole frame by stage and reason: {item, count} for one of the losses and their
// number, those that are shown on the map first, then by number.
function frameCauses(frame) {
    const all = new Map();
    const {begin, end} = scansOf(frame);
    for (let scan = begin; scan < end; scan++) {
        eachFate(scan, (object, pattern) => {
            for (const [cause, {item, count}] of causesOf(pattern)) {
                const known = all.get(cause) || {item, count: 0};
                known.count += count;
                all.set(cause, known);
            }
        });
    }
    return [...all.values()].sort((a, b) =>
        b.item.reason.notable - a.item.reason.notable || b.count - a.count);
}

// Visits the scans of the frame whose sensors are switched on.
function eachScan(visit) {
    const {begin, end} = scansOf(state.frame);
    for (let scan = begin; scan < end; scan++) {
        if (isSensorShown(scan)) {
            visit(scan);
        }
    }
}

// The losses of the frame for one cause, with their scans.
function lossesFor(cause) {
    const found = [];
    eachScan(scan => {
        eachFate(scan, (object, pattern) => {
            if (causesOf(pattern).has(cause)) {
                lossesOf(scan, object).filter(loss => causeOf(loss) === cause)
                    .forEach(loss => found.push({scan, loss}));
            }
        });
    });
    return found;
}

// Is it an echo of the chosen reflector? Where one echo was clicked, it must be that one.
function isChosenEcho(object, reflector, path, mirror, number) {
    const {echo} = state;
    return object === state.object && names[reflector] === state.reflector &&
        (echo === null || (echo.path === path && echo.mirror === mirror && echo.number === number));
}

// Where the echoes of the chosen reflector are: in targets and lost; else its spot.
function chosenPlaces() {
    const places = [];
    eachScan(scan => {
        eachContributor(scan, i => {
            const value = name => column('contributor_' + name)[i];
            if (isChosenEcho(value('object'), value('reflector'), value('path'), value('mirror'), value('number'))) {
                places.push(contributorPlace(scan, i));
            }
        });
        for (const loss of lossesOf(scan, state.object)) {
            const place = isChosenEcho(state.object, loss.reflector, loss.path, loss.mirror, loss.number)
                ? lossPlace(scan, loss) : null;
            places.push(...(place ? [place] : []));
        }
    });
    return places.length > 0 ? places : chosenSpot();
}

function chosenSpot() {
    const row = objectRow(state.frame, state.object);
    const spot = [...spotsOf(state.object)].find(([reflector]) => names[reflector] === state.reflector);
    return row >= 0 && spot ? [spotPlace(boxOf(row), spot[1])] : [];
}

function eachContributor(scan, visit) {
    const {begin, end} = targetsOf(scan);
    const parts = starts('target_contributors');
    for (let i = parts[begin]; i < parts[end]; i++) {
        visit(i);
    }
}
