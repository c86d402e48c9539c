// Headless Chromium on local files, without a network, and without leaving anything behind.

const {chromium} = require('playwright-core');

const flags = ['--no-sandbox', '--disable-gpu', '--disable-quic', '--no-first-run',
    '--disable-background-networking', '--disable-component-update', '--disable-sync'];

function launch() {
    return chromium.launch({
        executablePath: process.env.CHROMIUM || '/usr/bin/chromium',
        headless: true,
        args: flags,
    });
}

// A page, the complaints it made, and the requests it sent; prepare runs in it before its script.
async function open(browser, path, options, prepare) {
    const context = await browser.newContext({viewport: {width: 1280, height: 800}, ...options});
    await context.addInitScript(prepare || '');
    const page = await context.newPage();
    const complaints = [];
    const requests = [];
    page.on('console', message => {
        if (['error', 'warning'].includes(message.type())) {
            complaints.push(message.text());
        }
    });
    page.on('pageerror', error => complaints.push(String(error)));
    page.on('request', request => requests.push(request.url()));
    await page.goto('file://' + path);
    return {page, complaints, requests};
}

module.exports = {launch, open};
