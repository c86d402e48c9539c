// The panel of a chosen target: its values, its quality, and the echoes that it is made of.

const kindTitles = {ghost: ', a ghost', clutter: ', clutter', false_alarm: ', a false alarm', body: ''};

function showTarget() {
    const scan = scanOfTarget(state.frame, state.target);
    const number = state.target - targetsOf(scan).begin + 1;
    const title = make('h2');
    title.append(targetSymbol(scan, state.target),
        ` Target ${number} of ${sensorOf(scan).name}${kindTitles[kindOf(state.target)]}`);
    const order = numbersIn(contributorsOf(state.target));
    const weights = column('contributor_weight');
    order.sort((a, b) => weights[b] - weights[a]);
    const rows = order.slice(0, 40).map(i => contributorRow(scan, state.target, i));
    panel.replaceChildren(backButton(), title, valuesTable(scan, state.target),
        ...targetNotes(scan), ...block(`Made of ${plural(order.length, 'reflection centre')}`, rows),
        ...moreLine(order.length - rows.length), ...apartBlock(scan, state.target),
        make('p', cellWords(cellOf(scan)), 'soft'), ...qualityBlock(state.target));
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
