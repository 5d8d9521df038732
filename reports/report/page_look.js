// The look that all charts of a page follow: its theme, what is hidden, the width of a screen or of paper.
const pageLook = (() => {
    const asked = window.matchMedia('(prefers-color-scheme: dark)');
    const make = hidden => ({ theme: pageState.get('theme') || (asked.matches ? 'dark' : 'light'), hidden: new Set(hidden) });

    /// Keeps a page up with its reader and with paper. `paint` colours what is no chart; `beforePrint` may return what
    /// undoes it. The promise ends when the first charts are drawn.
    const follow = (look, cards, paint, beforePrint = () => undefined) => {
        const setTheme = next => {
            look.theme = next;
            paint();
            return cards.drawAll();
        };
        document.getElementById('theme').addEventListener('click', () => {
            setTheme(look.theme === 'dark' ? 'light' : 'dark');
            pageState.set('theme', look.theme);
        });
        asked.addEventListener('change', () => setTheme(asked.matches ? 'dark' : 'light'));
        // Ink on paper is dark, and charts are as wide as the paper: shrunk ones could not be read.
        let before = null, undo;
        window.addEventListener('beforeprint', () => {
            before = look.theme;
            look.paperWidth = 700;
            undo = beforePrint();
            setTheme('light');
        });
        window.addEventListener('afterprint', () => {
            look.paperWidth = 0;
            if (undo) undo();
            setTheme(before);
        });
        let lastWidth = window.innerWidth, resizing = null;
        window.addEventListener('resize', () => {
            if (window.innerWidth === lastWidth) return;
            lastWidth = window.innerWidth;
            clearTimeout(resizing);
            resizing = setTimeout(cards.drawAll, 200);
        });
        paint();
        return cards.drawFirst().then(() => {
            pageState.scrollToAnchor();
            document.documentElement.dataset.ready = String(Math.round(performance.now()));
        });
    };
    /// Marks the page with its theme, and gives elements with `data-KIND` the colour of what that names.
    const painter = (look, kind, colourOf) => () => {
        document.documentElement.dataset.theme = look.theme;
        document.getElementById('theme').textContent = look.theme === 'dark' ? 'Light' : 'Dark';
        for (const marked of document.querySelectorAll(`[data-${kind}]`)) marked.style.setProperty('--colour', colourOf(marked.dataset[kind]));
    };
    return { make, follow, painter };
})();
