// Reads the tables of a stream with DuckDB, and what the statements of schemas/README.md make of them with hyparquet:
// every row must be what the stream's lines say, and so must the labels of an export, joined as its page says.
// Usage: tests/tables/run BIN_DIR [DETECTIONS]
import fs from 'node:fs';
import readline from 'node:readline';
import {execFileSync, spawn} from 'node:child_process';
import {DuckDBInstance} from '@duckdb/node-api';
import {asyncBufferFromFile, parquetMetadataAsync, parquetRead} from 'hyparquet';
import {compressors} from 'hyparquet-compressors';

const TABLES = ['detections', 'objects', 'scans', 'contributors', 'sightings', 'lost', 'frames'];
// Numbers of a sighting, which a line lacks where they are 0.
const COUNTS = ['reflectors', 'in_range', 'in_view', 'blocked_share', 'detections', 'merged', 'ghosts'];
const [work, most] = [process.argv[2], Number(process.argv[3])];
// So many frames of this stream have a million detections.
const DETECTIONS_A_FRAME = 26.5;
const CHAIN = 'glint-extract | glint-ideal --sensors corner77-four ACCOUNT | glint-sensor | glint-noise';
let faults = 0;

// Lost echoes with the object and the path that a line leaves out: those of the echo before, and "direct".
function named(echoes) {
    let object = null;
    return echoes.map(echo => ({path: 'direct', ...echo, object: object = echo.object ?? object}));
}

function stream(frames, account, seed) {
    return `glint-traffic-random --density dense --frames ${frames} --seed ${seed} | ${CHAIN.replace('ACCOUNT', account)}`;
}

function check(good, text) {
    if (good)
        return;
    console.log(`FAILED   ${text}`);
    if (++faults === 10)
        process.exit(1);
}

// The statements of the page: the one that copies a table, and the one that makes the view.
function statements() {
    const page = fs.readFileSync('schemas/README.md', 'utf8');
    const found = [...page.matchAll(/```sql\n([^]*?)```/g)].map(block => block[1]);
    return {
        copy: found.find(text => text.startsWith('COPY')).trim(),
        view: found.find(text => text.startsWith('CREATE VIEW radar')).trim(),
    };
}

async function open(folder) {
    const instance = await DuckDBInstance.create(':memory:');
    const database = await instance.connect();
    database.another = () => instance.connect();
    await database.run(fs.readFileSync('schemas/tables.sql', 'utf8'));
    await database.run(statements().view.replaceAll("'tables'", `'${folder}'`));
    return database;
}

// Makes the tables of a stream, and Parquet of them by the statement of the page.
async function make(commands, folder) {
    fs.mkdirSync(folder, {recursive: true});
    execFileSync('glint', ['-c', `${commands} | glint-tables ${folder}`]);
    const database = await open(folder);
    const {copy} = statements();
    check(/detections\('tables'/.test(copy) && /'detections.parquet'/.test(copy), 'the page copies another table');
    for (const table of TABLES)
        await database.run(copy.replaceAll('detections', table).replace("'tables'", `'${folder}'`)
            .replace(`'${table}.parquet'`, `'${folder}/${table}.parquet'`));
    return database;
}

// The columns of a Parquet file: {name: values}.
async function columnsOf(path) {
    const file = await asyncBufferFromFile(path);
    const columns = {};
    const metadata = await parquetMetadataAsync(file);
    for (const {name} of metadata.schema.slice(1))
        columns[name] = [];
    await parquetRead({file, compressors, onChunk({columnName, columnData, rowStart}) {
        for (let i = 0; i < columnData.length; i++)
            columns[columnName][rowStart + i] = columnData[i];
    }});
    return columns;
}

// Rows of a query, one after the other, as objects. A connection has one stream at a time.
async function* rowsOf(database, query) {
    const result = await (await database.another()).stream(query);
    const names = result.columnNames();
    for (;;) {
        const chunk = await result.fetchChunk();
        if (chunk === null || chunk.rowCount === 0)
            return;
        for (const row of chunk.getRows())
            yield Object.fromEntries(row.map((value, i) => [names[i], value]));
    }
}

// Members that are single values.
function values(record, without = []) {
    const found = {};
    for (const [key, value] of Object.entries(record))
        if (key === 'effects')
            found[key] = value.join(' ');
        else if (typeof value !== 'object' && !without.includes(key))
            found[key] = value;
    return found;
}

// What the lines say of a frame's rows; keys count from frame to frame.
function rowsOfFrame(frame, next) {
    const rows = {detections: [], objects: [], scans: [], contributors: [], sightings: [], lost: [], frames: []};
    const when = {scene: frame.scene, frame: frame.frame, time_s: frame.time_s};
    const whole = {frame_key: next.frame, ...when, seed: BigInt(frame.seed), ego: frame.ego, last: frame.last === true,
        interval_s: frame.interval_s, suite: frame.sensors.suite};
    rows.frames.push(whole);
    const keys = new Map(), classes = new Map();
    for (const object of frame.objects) {
        keys.set(object.id, next.object);
        classes.set(object.id, object.class);
        rows.objects.push({object_key: next.object++, frame_key: next.frame, ...when, ...values(object)});
    }
    for (const sensor of frame.sensors.list.filter(one => one.measured)) {
        const targets = frame.targets.filter(one => one.sensor === sensor.name);
        rows.scans.push({scan_key: next.scan, ...whole, sensor: sensor.name,
            measured_s: frame.time_s - (sensor.age_s ?? 0), detections: targets.length,
            ...values(sensor, ['name', 'measured', 'age_s'])});
        targets.forEach((target, detection) => {
            const best = target.contributors.reduce((a, b) => b.weight > a.weight ? b : a);
            rows.detections.push({detection_key: next.detection, scan_key: next.scan, frame_key: next.frame, detection, ...when,
                sign_undecided: false, ...values(target), object_key: keys.get(best.object) ?? null,
                class: classes.get(best.object) ?? null, contributors: target.contributors.length,
                object: best.object, reflector: best.reflector, path: best.path, mirror: best.mirror ?? null,
                weight: best.weight});
            target.contributors.forEach((part, contributor) => rows.contributors.push({
                detection_key: next.detection, contributor, object_key: keys.get(part.object) ?? null, ...values(part)}));
            next.detection++;
        });
        for (const sighting of frame.visibility ?? [])
            if (sighting.sensor === sensor.name)
                rows.sightings.push({scan_key: next.scan, object_key: keys.get(sighting.object), visibility: null,
                    ...Object.fromEntries(COUNTS.map(name => [name, 0])), ...sighting});
        for (const group of frame.lost ?? [])
            if (group.sensor === sensor.name)
                for (const echo of named(group.echoes))
                    rows.lost.push({scan_key: next.scan, object_key: keys.get(echo.object) ?? null, ...values(group),
                        ...values(echo)});
        next.scan++;
    }
    next.frame++;
    return rows;
}

// Is this what the line says? A value in single precision is its rounding.
function same(value, wanted, single) {
    if (typeof value === 'bigint' && typeof wanted === 'number')
        value = Number(value);
    return value === wanted || (single && typeof wanted === 'number' && value === Math.fround(wanted)) ||
        (value == null && wanted === '');
}

async function compare(commands, folder, database) {
    const packed = {}, plain = {}, next = {frame: 0, scan: 0, object: 0, detection: 0};
    const at = Object.fromEntries(TABLES.map(table => [table, 0]));
    for (const table of TABLES) {
        packed[table] = await columnsOf(`${folder}/${table}.parquet`);
        plain[table] = rowsOf(database, `FROM ${table}('${folder}')`);
    }
    const child = spawn('glint', ['-c', commands], {stdio: ['ignore', 'pipe', 'inherit']});
    for await (const line of readline.createInterface({input: child.stdout})) {
        const wanted = rowsOfFrame(JSON.parse(line), next);
        for (const table of TABLES)
            for (const row of wanted[table]) {
                const read = (await plain[table].next()).value ?? {};
                for (const name of Object.keys(row)) {
                    check(same(read[name], row[name], false),
                        `DuckDB: ${table}.${name}[${at[table]}] is ${read[name]}, expected ${row[name]}`);
                    check(same(packed[table][name]?.[at[table]], row[name], true),
                        `hyparquet: ${table}.${name}[${at[table]}] is ${packed[table][name]?.[at[table]]}, expected ${row[name]}`);
                }
                at[table]++;
            }
    }
    for (const table of TABLES) {
        check((await plain[table].next()).done, `DuckDB: ${table} has more rows than the lines`);
        const [first] = Object.values(packed[table]);
        check(first.length === at[table], `hyparquet: ${table} has ${first.length} rows, expected ${at[table]}`);
    }
    console.log(`DuckDB and hyparquet read ${TABLES.map(table => `${at[table]} ${table}`).join(', ')}`);
    return at;
}

// The 15 columns of the radar table of NVIDIA's PhysicalAI-AV data set: names, order and types.
const RADAR = {scan_index: 'BIGINT', timestamp: 'BIGINT', sensor_timestamp: 'BIGINT', num_returns: 'BIGINT',
    doppler_ambiguity: 'FLOAT', max_returns: 'DOUBLE', detection_index: 'BIGINT', radar_model: 'UTINYINT',
    azimuth: 'FLOAT', elevation: 'FLOAT', distance: 'FLOAT', radial_velocity: 'FLOAT', rcs: 'FLOAT', snr: 'FLOAT',
    exist_probb: 'UTINYINT'};

async function checkView(folder, database) {
    const described = (await database.runAndReadAll('DESCRIBE radar')).getRows();
    check(JSON.stringify(described.map(row => row.slice(0, 2))) === JSON.stringify(Object.entries(RADAR)),
        `the view has the columns ${described.map(row => row.slice(0, 2).join(' '))}`);
    const detections = rowsOf(database, `FROM detections('${folder}')`);
    let rows = 0, scan = -1n, index = 0n;
    for await (const row of rowsOf(database, 'FROM radar')) {
        const {value} = await detections.next();
        index = row.scan_index === scan ? index + 1n : 0n;
        scan = row.scan_index;
        check(row.detection_index === index && index < row.num_returns && row.azimuth === Math.fround(value.azimuth_rad) &&
            row.distance === Math.fround(value.range_m) && row.radial_velocity === Math.fround(value.range_rate_mps) &&
            row.timestamp === BigInt(Math.round(value.time_s * 1e6)), `row ${rows} of the view is another detection`);
        rows++;
    }
    check((await detections.next()).done && rows > 0, 'the view has too few rows');
}

function bytesOf(path) {
    return fs.statSync(path).size;
}

// Bytes for 36 detections: of the 15 columns with the label, and of all seven tables.
async function measure(folder, database, detections) {
    const options = statements().copy.match(/\([^()]*\);$/)[0].slice(0, -1);
    await database.run(`COPY (SELECT radar.*, object, class, reflector, path, mirror, effects FROM radar
        JOIN detections('${folder}') ON scan_index = scan_key AND detection_index = detection ORDER BY detection_key)
        TO '${folder}/radar.parquet' ${options}`);
    const radar = bytesOf(`${folder}/radar.parquet`) / detections * 36;
    const each = TABLES.map(table => bytesOf(`${folder}/${table}.parquet`) / detections * 36);
    const all = each.reduce((a, b) => a + b);
    console.log(`36 detections in Parquet: ${radar.toFixed(0)} bytes as 15 columns and label, ${all.toFixed(0)} as seven ` +
        `tables (${TABLES.map((table, i) => `${table} ${each[i].toFixed(0)}`).join(', ')})`);
    check(radar <= 1500, 'more than 1500 bytes as 15 columns and label');
    check(all <= 6000, 'more than 6000 bytes as seven tables');
}

async function run(name, commands) {
    const folder = `${work}/${name}`;
    const database = await make(commands, folder);
    const rows = await compare(commands, folder, database);
    await checkView(folder, database);
    await measure(folder, database, rows.detections);
    return rows;
}

// DuckDB must not take its dialect from names.
async function runNamed(folder, name) {
    const commands = `glint-traffic cut-in --scene "${name}" | ${CHAIN.replace('ACCOUNT', '')}`;
    await compare(commands, folder, await make(commands, folder));
}

// The statement of data/exports/README.md joins each label of an exported point with what the sensor measured.
async function checkExport(place) {
    const page = fs.readFileSync('data/exports/README.md', 'utf8'), out = `${place}/cut-in-nuscenes`;
    fs.mkdirSync(place);
    execFileSync('glint', ['-c', `glint-traffic cut-in | ${CHAIN.replace('ACCOUNT', '--sections quality')} -o ${place}/list.jsonl`]);
    execFileSync('scripts/export', ['nuscenes', '--out', out, `${place}/list.jsonl`]);
    execFileSync('glint-tables', [`${place}/tables`, `${place}/list.jsonl`]);
    const lines = fs.readFileSync(`${place}/list.jsonl`, 'utf8').trim().split('\n').map(JSON.parse);
    const expected = lines.flatMap(frame => frame.targets.flatMap(target => target.contributors.map(part =>
        `${part.object} ${part.path} ${part.weight} ${target.range_m}`))).sort();
    const statement = page.match(/```sql\n(SELECT [^]*?)```/)[1].replaceAll("'cut-in-nuscenes", `'${out}`).replaceAll("'tables'", `'${place}/tables'`);
    const found = [];
    for await (const row of rowsOf(await open(`${place}/tables`), statement.trim().replace(/;$/, '')))
        found.push(`${row.object} ${row.echo} ${row.weight} ${row.range_m}`);
    check(found.length > 1000 && JSON.stringify(found.sort()) === JSON.stringify(expected), 'labels and measurements are joined in another way');
}

await checkExport(`${work}/export`);
await runNamed(`${work}/apostrophe`, "'");
await run('accounted', stream(2000, '--sections account,visibility', 1));
const rows = await run('plain', stream(Math.ceil(most / DETECTIONS_A_FRAME), '', 2));
check(rows.detections >= most, `${rows.detections} detections, expected ${most}`);
process.exit(faults > 0 ? 1 : 0);
