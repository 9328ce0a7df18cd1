"""How well colours can be words apart, as the accessibility guidelines define it: of styles, and in a browser."""

#: Of what can be used, its letters and what shows where it is: each with the colour that it stands on.
SEEN = """selector => {
    const parts = (text) => {
        const [r, g, b, a = 1] = text.match(/[\\d.]+(?:e-?\\d+)?/g).map(Number);
        return text.startsWith('color(') ? [r, g, b, a] : [r / 255, g / 255, b / 255, a];
    };
    const over = (top, below) => top.map((x, i) => i < 3 ? x * top[3] + below[i] * (1 - top[3]) : 1);
    const ground = (x) => !x ? [1, 1, 1, 1] : over(parts(getComputedStyle(x).backgroundColor), ground(x.parentElement));
    const found = [];
    for (const x of document.querySelectorAll(`:is(${selector}):not([type=range])`)) {
        if (!x.checkVisibility({ visibilityProperty: true })) continue;
        const style = getComputedStyle(x);
        const name = (x.id || x.getAttribute('aria-label') || x.textContent).trim().slice(0, 40);
        const at = ground(x), around = ground(x.parentElement);
        found.push([name + ', letters', over(parts(style.color), at), at]);
        if (x.matches('button, input:not([type=radio], [type=checkbox])')) {
            found.push([name + ', border', over(parts(style.borderTopColor), around), around]);
        }
    }
    return found;
}"""


def contrast(a, b):
    """The contrast of two colours, "#rrggbb" or channels from 0 to 1."""

    def light(colour):
        if isinstance(colour, str):
            colour = [int(colour[i : i + 2], 16) / 255 for i in (1, 3, 5)]
        r, g, b = [c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in colour[:3]]
        return 0.2126 * r + 0.7152 * g + 0.0722 * b

    lighter, darker = sorted((light(a), light(b)), reverse=True)
    return (lighter + 0.05) / (darker + 0.05)


def low(tab, selector, least=4.5):
    """What of the elements of a page that are seen has less contrast, and how much; and how many were looked at."""
    found = [(name, round(contrast(a, b), 2)) for name, a, b in tab.evaluate(SEEN, selector)]
    return [one for one in found if one[1] < least], len(found)
