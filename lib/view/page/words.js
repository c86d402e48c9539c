// Numbers, paths of echoes and reasons of losses, in words.

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

// What tells a contributor from other echoes of its reflector.
function echoOfContributor(i) {
    const value = name => column('contributor_' + name)[i];
    return {path: value('path'), mirror: value('mirror'), number: value('number')};
}

function contributorWords(i) {
    return echoWords(column('contributor_reflector')[i], echoOfContributor(i));
}

function contributorPath(i) {
    return pathWords(column('contributor_path')[i], column('contributor_mirror')[i],
        column('contributor_number')[i]);
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

function silentWords(reason) {
    return reason === 'no_specular_point' ? 'mirroring past the sensor' : words(reason);
}

function effectNote(effect) {
    return effect ? ` (${words(effect)})` : '';
}

// Share in view, in the levels of nuScenes, by number (lib/frame/sightings.h).
const levels = ['0 to 40 %', '40 to 60 %', '60 to 80 %', '80 to 100 %'];

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

// The resolution cell that is drawn around a chosen target.
function cellWords(cell) {
    if (!cell) {
        return 'The stream does not tell the size of the radar’s cell.';
    }
    return `The radar’s cell: ${metres(cell.range_m)} m (dashed arcs on the map) by ` +
        `${metres(cell.range_rate_mps)} m/s (a box in range over rate, if enlarged enough). Echoes within half ` +
        'of it of a stronger one, in both, become one target with it, unless an array tells their angles apart.';
}
