// Why a target stands apart from others of its scan: how far off they are, in cells of the radar.

// A value of the echo that opened a target's cell, without noise, and folded where the target's is.
function openedAt(name, target) {
    return column('contributor_' + name)[leaderOf(target)] +
        column('target_cell_' + name)[target] - exactValue(name, target);
}

// How far a target lies from another in each value that the radar tells apart, the most cells first; in words
// that follow the text, # stands for the other.
function waysApart(scan, target, other) {
    const cell = cellOf(scan);
    const beam = sensorOf(scan).azimuth_cell_rad;
    const apart = name => openedAt(name, target) - openedAt(name, other);
    const way = (by, size, text, words) => ({cells: Math.abs(by) / size,
        text: `${text} = ${round(Math.abs(by) / size, 1)} cells`, words: words[by < 0 ? 0 : 1]});
    const [range, rate] = ['range_m', 'range_rate_mps'].map(apart);
    const azimuth = column('target_cell_azimuth_rad')[target] - column('target_cell_azimuth_rad')[other];
    const ways = [
        way(range, cell.range_m, `${round(Math.abs(range), 2)} m`, ['in front of #', 'behind #']),
        way(rate, cell.range_rate_mps, `${round(Math.abs(rate), 2)} m/s`, ['of rate below #', 'of rate above #']),
        ...beam > 0 ? [way(azimuth, beam, `${round(degrees * Math.abs(azimuth), 1)}°`, ['right of #', 'left of #'])] : [],
    ];
    return ways.sort((a, b) => b.cells - a.cells);
}

// "0.71 m = 2.4 cells behind target 1": what tells a target most from another one.
function apartLine(scan, target, other) {
    const [{text, words}] = waysApart(scan, target, other.target);
    return make('div', `${text} ${words.replace('#', `target\u00a0${other.number}`)}`, 'soft');
}

// The targets of a scan that lie nearest to one: those of its object first.
function neighboursOf(scan, target) {
    const own = targetPlace(scan, target);
    const {begin, end} = targetsOf(scan);
    const others = [];
    for (let other = begin; other < end; other++) {
        const place = targetPlace(scan, other);
        if (other !== target && kindOf(other) !== 'false_alarm') {
            others.push({other, number: other - begin + 1, foreign: objectOfTarget(other) !== objectOfTarget(target),
                distance: Math.hypot(place.x - own.x, place.y - own.y)});
        }
    }
    return others.sort((a, b) => a.foreign - b.foreign || a.distance - b.distance).slice(0, 4);
}

// A target beside one: by the way in which they are farthest apart, and the others.
function neighbourRow(scan, target, {other, number, foreign}) {
    const [first, ...others] = waysApart(scan, target, other);
    const name = `target\u00a0${number}${foreign ? ` of ${names[objectOfTarget(other)]}` : ''}`;
    const line = [make('b', first.text), ` ${first.words.replace('#', () => name)}`,
        make('div', others.map(one => `${one.text} ${one.words.replace('#', 'it')}`).join(', '), 'soft')];
    return rowButton(targetSymbol(scan, other), line, '', () => chooseTarget(other));
}

function apartBlock(scan, target) {
    const rows = cellOf(scan) && kindOf(target) !== 'false_alarm'
        ? neighboursOf(scan, target).map(one => neighbourRow(scan, target, one)) : [];
    return block('Why are these apart?', rows);
}
