// How far colours are apart for people who see two kinds of cones: the matrices of Machado, Oliveira
// and Fernandes (IEEE TVCG 15, 2009) at severity 1, and CIEDE2000 (ISO/CIE 11664-6).

const sights = {
    normal: [[1, 0, 0], [0, 1, 0], [0, 0, 1]],
    protanopia: [[0.152286, 1.052583, -0.204868], [0.114503, 0.786281, 0.099216], [-0.003882, -0.048116, 1.051998]],
    deuteranopia: [[0.367322, 0.860646, -0.227968], [0.280085, 0.672501, 0.047413], [-0.011820, 0.042940, 0.968881]],
    tritanopia: [[1.255528, -0.076749, -0.178779], [-0.078411, 0.930809, 0.147602], [0.004733, 0.691367, 0.303900]],
};
const toXyz = [[0.4124564, 0.3575761, 0.1804375], [0.2126729, 0.7151522, 0.0721750], [0.0193339, 0.1191920, 0.9503041]];
const radians = Math.PI / 180;

const times = (matrix, vector) => matrix.map(row => row.reduce((sum, value, i) => sum + value * vector[i], 0));

// Linear light of "#rrggbb".
function linear(colour) {
    return [1, 3, 5].map(at => {
        const value = parseInt(colour.slice(at, at + 2), 16) / 255;
        return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
    });
}

// CIE L*a*b* under D65.
function lab(light) {
    const [x, y, z] = times(toXyz, light.map(value => Math.min(1, Math.max(0, value))))
        .map((value, i) => value / [0.95047, 1, 1.08883][i])
        .map(value => value > 216 / 24389 ? Math.cbrt(value) : (24389 / 27 * value + 16) / 116);
    return [116 * y - 16, 500 * (x - y), 200 * (y - z)];
}

function hue(b, a) {
    return (Math.atan2(b, a) / radians + 360) % 360;
}

function ciede2000([l1, a1, b1], [l2, a2, b2]) {
    const seventh = c => Math.sqrt(c ** 7 / (c ** 7 + 25 ** 7));
    const g = 0.5 * (1 - seventh((Math.hypot(a1, b1) + Math.hypot(a2, b2)) / 2));
    const c1 = Math.hypot((1 + g) * a1, b1);
    const c2 = Math.hypot((1 + g) * a2, b2);
    const h1 = hue(b1, (1 + g) * a1);
    const h2 = hue(b2, (1 + g) * a2);
    const turn = c1 * c2 === 0 ? 0 : ((h2 - h1 + 540) % 360) - 180;
    const l = (l1 + l2) / 2;
    const c = (c1 + c2) / 2;
    const h = c1 * c2 === 0 ? h1 + h2 : Math.abs(h1 - h2) <= 180 ? (h1 + h2) / 2 : ((h1 + h2 + 360) / 2) % 360;
    const cosine = angle => Math.cos(angle * radians);
    const t = 1 - 0.17 * cosine(h - 30) + 0.24 * cosine(2 * h) + 0.32 * cosine(3 * h + 6) - 0.2 * cosine(4 * h - 63);
    const dl = (l2 - l1) / (1 + 0.015 * (l - 50) ** 2 / Math.sqrt(20 + (l - 50) ** 2));
    const dc = (c2 - c1) / (1 + 0.045 * c);
    const dh = 2 * Math.sqrt(c1 * c2) * Math.sin(turn / 2 * radians) / (1 + 0.015 * c * t);
    const rotation = -2 * seventh(c) * Math.sin(60 * Math.exp(-(((h - 275) / 25) ** 2)) * radians);
    return Math.sqrt(dl ** 2 + dc ** 2 + dh ** 2 + rotation * dc * dh);
}

// The least distance of two of the colours, for the sight that tells them apart worst.
function leastApart(colours) {
    let least = {distance: Infinity};
    for (const [sight, matrix] of Object.entries(sights)) {
        const seen = colours.map(colour => lab(times(matrix, linear(colour))));
        seen.forEach((one, i) => seen.slice(0, i).forEach((other, j) => {
            const distance = ciede2000(one, other);
            if (distance < least.distance) {
                least = {distance, sight, pair: [colours[j], colours[i]]};
            }
        }));
    }
    return least;
}

// The contrast of two colours by WCAG 2.
function contrast(one, other) {
    const [low, high] = [one, other].map(colour => times(toXyz, linear(colour))[1]).sort((a, b) => a - b);
    return (high + 0.05) / (low + 0.05);
}

module.exports = {ciede2000, contrast, leastApart};
