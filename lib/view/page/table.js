// The table of a frame's targets: sorted, searched, copied. Only the rows in view are elements, and
// they are used again from frame to frame.

const tableColumns = [
    {title: '', value: row => row.order},
    {title: 'range m', digits: 2, value: row => column('target_range_m')[row.target]},
    {title: 'azim. °', tells: 'off the boresight of its sensor', digits: 1, value: row => column('target_azimuth_rad')[row.target] * degrees},
    {title: 'rate m/s', digits: 2, value: row => rateOf(row.scan, row.target, state.rates === 'compensated')},
    {title: 'level dB', digits: 1, value: row => column('target_amplitude_db')[row.target]},
    {title: 'object', value: row => names[objectOfTarget(row.target)]},
];
const rowHeight = 28; // px, as the style has it

const table = {
    sort: 0, // index among tableColumns
    descending: false,
    rows: [],
    elements: [],
    laid: '', // which rows of how many are in the page
    body: document.querySelector('#targets tbody'),
    scroll: document.querySelector('#targets .scroll'),
};

// All words by which a target can be found.
function searchWords({scan, target}) {
    const found = [sensorOf(scan).name];
    const {begin, end} = contributorsOf(target);
    for (let i = begin; i < end; i++) {
        found.push(names[column('contributor_object')[i]], names[column('contributor_reflector')[i]],
            words(head.paths[column('contributor_path')[i]]));
    }
    const kind = classOfObject(state.frame, objectOfTarget(target));
    return found.concat(kind < 0 ? [] : names[kind]).join(' ').toLowerCase();
}

function compareRows(a, b) {
    const {value} = tableColumns[table.sort];
    const left = value(a);
    const right = value(b);
    const way = left < right ? -1 : left > right ? 1 : 0;
    return (table.descending ? -way : way) || a.order - b.order;
}

// The targets that are shown and found, in the order of the table.
function tableRows() {
    const wanted = control('search').value.toLowerCase().split(/\s+/).filter(Boolean);
    const rows = [];
    eachTarget(state.frame, (scan, target) => rows.push({scan, target, order: rows.length}));
    const found = wanted.length === 0 ? rows : rows.filter(row => {
        const text = searchWords(row);
        return wanted.every(word => text.includes(word));
    });
    return found.sort(compareRows);
}

function cellText(row, i) {
    const {value, digits} = tableColumns[i];
    return digits === undefined ? String(value(row)) : round(value(row), digits);
}

function makeRow() {
    const row = make('tr');
    const mark = make('td');
    const symbol = make('canvas');
    mark.append(symbol, make('span'));
    row.append(mark, ...tableColumns.slice(1).map(one => make('td', '', one.digits === undefined ? 'name' : 'number')));
    row.addEventListener('click', () => chooseTarget(Number(row.dataset.target)));
    row.addEventListener('dblclick', () => showPane('panel'));
    row.addEventListener('pointerenter', () => setHover(Number(row.dataset.target)));
    row.addEventListener('pointerleave', () => setHover(-1));
    return row;
}

function setText(element, text) {
    if (element.textContent !== text) {
        element.textContent = text;
    }
}

// Draws the symbol anew only where it differs from the one that the row had before.
function setSymbol(symbol, scan, target) {
    const look = [sensorStyle(scan), colourOf(scan, target), kindOf(target), isDark()].join();
    if (symbol.dataset.look !== look) {
        symbol.dataset.look = look;
        paintSymbol(symbol, sensorStyle(scan), colourOf(scan, target), 18, kindOf(target));
    }
}

function fillRow(element, row) {
    element.dataset.target = String(row.target);
    element.classList.toggle('chosen', row.target === state.target);
    element.classList.toggle('hover', row.target === state.hover);
    element.toggleAttribute('aria-current', row.target === state.target);
    const [mark, ...cells] = element.children;
    setSymbol(mark.firstChild, row.scan, row.target);
    setText(mark.lastChild, String(row.target - targetsOf(row.scan).begin + 1));
    cells.forEach((cell, i) => setText(cell, cellText(row, i + 1)));
}

function spacer(rows) {
    const empty = make('tr');
    empty.setAttribute('aria-hidden', 'true');
    const cell = make('td');
    cell.colSpan = tableColumns.length;
    cell.style.height = rows * rowHeight + 'px';
    empty.append(cell);
    return rows > 0 ? [empty] : [];
}

function showRowsInView() {
    const first = Math.max(0, Math.min(Math.floor(table.scroll.scrollTop / rowHeight) - 2, table.rows.length - 1));
    const count = Math.min(table.rows.length - first, Math.ceil(table.scroll.clientHeight / rowHeight) + 5);
    while (table.elements.length < count) {
        table.elements.push(makeRow());
    }
    const shown = table.elements.slice(0, count);
    shown.forEach((element, i) => fillRow(element, table.rows[first + i]));
    const laid = [first, count, table.rows.length].join();
    if (table.laid !== laid) { // else the rows stand where they are
        table.laid = laid;
        table.body.replaceChildren(...spacer(first), ...shown, ...spacer(table.rows.length - first - count));
    }
}

function markHoveredRow() {
    for (const element of table.elements) {
        element.classList.toggle('hover', Number(element.dataset.target) === state.hover);
    }
}

function fillTable() {
    table.rows = state.frame < 0 ? [] : tableRows();
    setText(control('found'), plural(table.rows.length, 'target'));
    showRowsInView();
}

function sortTable(i) {
    table.descending = table.sort === i && !table.descending;
    table.sort = i;
    [...document.querySelectorAll('#targets th')].forEach((heading, at) => {
        heading.setAttribute('aria-sort', at !== i ? 'none' : table.descending ? 'descending' : 'ascending');
    });
    fillTable();
}

// Chooses the target a number of rows on, and brings its row into view.
function chooseRow(step) {
    const at = table.rows.findIndex(row => row.target === state.target);
    const next = Math.max(0, Math.min(table.rows.length - 1, at < 0 ? 0 : at + step));
    if (table.rows.length === 0) {
        return;
    }
    const top = next * rowHeight;
    const room = table.scroll.clientHeight - 2 * rowHeight;
    table.scroll.scrollTop = Math.max(top - room, Math.min(table.scroll.scrollTop, top));
    chooseTarget(table.rows[next].target);
}

// The whole table with a line of headings, in columns separated by tabs.
function tableText() {
    const headings = ['sensor', 'target', 'range_m', 'azimuth_deg', 'range_rate_mps', 'amplitude_db', 'object'];
    const lines = tableRows().map(row => [sensorOf(row.scan).name, row.target - targetsOf(row.scan).begin + 1,
        ...tableColumns.slice(1).map((_, i) => cellText(row, i + 1))]);
    return [headings, ...lines].map(cells => cells.map(cell => String(cell).replace(/[\u2068\u2069]/g, '').replace(/\s+/g, ' ')).join('\t') + '\n')
        .join('');
}

// Copies a text; the button says for a moment whether that went well, then what it is for.
function copyText(text, told, [well, ill, usual]) {
    const put = event => {
        event.clipboardData.setData('text/plain', text);
        event.preventDefault();
    };
    document.addEventListener('copy', put, {once: true});
    told.textContent = document.execCommand('copy') ? well : ill;
    document.removeEventListener('copy', put);
    setTimeout(() => { told.textContent = usual; }, 1200);
}

function copyTable() {
    copyText(tableText(), control('copy'), ['Copied', 'Not copied', 'Copy']);
}

function connectTable() {
    panes.get('targets').fill = fillTable;
    tableColumns.forEach((one, i) => {
        const heading = make('th', null, one.digits === undefined ? 'name' : 'number');
        const sorter = button('', () => sortTable(i));
        Object.assign(sorter, {textContent: one.title || 'no.', title: one.tells || ''});
        heading.append(sorter);
        document.querySelector('#targets thead tr').append(heading);
    });
    document.querySelectorAll('#targets th')[0].setAttribute('aria-sort', 'ascending');
    table.scroll.addEventListener('scroll', showRowsInView);
    new ResizeObserver(showRowsInView).observe(table.scroll);
    control('search').addEventListener('input', fillTable);
    control('search').addEventListener('keydown', event => {
        if (event.key === 'Escape') {
            control('search').value = '';
            fillTable();
            table.scroll.focus();
        }
    });
    control('copy').addEventListener('click', copyTable);
}
