"""The page in a real browser: Debian's Chromium, driven by Playwright."""

import os
import shutil

import pytest

from hodograph.explorer.page import html

NAMES = ("chromium", "chromium-browser", "google-chrome")


@pytest.fixture(scope="session")
def chromium():
    """A browser, one for all tests; where there is none, they are skipped and say so."""
    playwright = pytest.importorskip(
        "playwright.sync_api", reason="no Playwright here: pip install hodograph[browser]"
    )
    found = next(filter(None, map(shutil.which, NAMES)), None)
    if found is None:
        pytest.skip(f"no browser here: none of {', '.join(NAMES)}")
    arguments = ["--no-sandbox"] if getattr(os, "geteuid", lambda: 1)() == 0 else []
    with playwright.sync_playwright() as driver:
        browser = driver.chromium.launch(executable_path=found, args=arguments)
        yield browser
        browser.close()


@pytest.fixture(scope="session")
def address(tmp_path_factory):
    path = tmp_path_factory.mktemp("explorer") / "page.html"
    path.write_text(html(), encoding="utf-8")
    return path.as_uri()


@pytest.fixture
def visit(chromium, address):
    """Opens the page; it must say nothing on the console and ask nothing of any network."""
    said, asked, contexts = [], [], []

    def go(hash_="", *, width=1280, height=860, **options):
        options = {"locale": "en-GB"} | options
        context = chromium.new_context(viewport={"width": width, "height": height}, **options)
        contexts.append(context)
        page = context.new_page()
        page.set_default_timeout(10_000)
        page.on("console", lambda message: said.append(message.text))
        page.on("pageerror", lambda error: said.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        page.goto(address + hash_)
        for part in ("#map-over text", "#errors tr", "#convergence"):
            page.wait_for_selector(part, state="attached")
        return page

    yield go
    for context in contexts:
        context.close()
    assert said == []
    assert {url for url in asked if not url.startswith(("data:", "blob:"))} == {
        url for url in asked if url.partition("#")[0] == address
    }
