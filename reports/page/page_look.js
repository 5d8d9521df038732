// The look that all charts of a page share: theme, hidden methods or machines, width of the screen or paper.
const pageLook = (() => {
    const asked = window.matchMedia('(prefers-color-scheme: dark)');
    const make = hidden => ({ theme: pageState.get('theme') || (asked.matches ? 'dark' : 'light'), hidden: new Set(hidden) });

    /// Adapts the page to changes of theme and width and to printing. `paint` colours everything except charts; `beforePrint`
    /// may return a function that undoes it. The promise resolves when the first charts are drawn.
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
        // Prints in the light theme, with charts as wide as the paper: shrunk ones would be unreadable.
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
    /// Marks the page with its theme, and gives elements with `data-KIND` the colour of the method or machine it names.
    const painter = (look, kind, colourOf) => () => {
        document.documentElement.dataset.theme = look.theme;
        document.getElementById('theme').textContent = look.theme === 'dark' ? 'Light' : 'Dark';
        for (const marked of document.querySelectorAll(`[data-${kind}]`)) marked.style.setProperty('--colour', colourOf(marked.dataset[kind]));
    };
    return { make, follow, painter };
})();
