"""Acts as a user on a page in chromium, and prints what the script saw.

    /usr/bin/python3 tests/act.py PAGE < SCRIPT

SCRIPT is the body of an asynchronous function in JavaScript; what it returns is printed. Selenium waits in real time for
what the script awaits: Chromium's own --virtual-time-budget ends while a picture is still being encoded on a busy machine.
"""
import pathlib
import shutil
import sys

from selenium import webdriver
from selenium.webdriver.chrome.service import Service

RUN = """
const told = arguments[arguments.length - 1];
(async () => {%s})().then(String, String).then(told);
"""

options = webdriver.ChromeOptions()
for argument in ("headless", "no-sandbox", "disable-gpu", "no-first-run", "window-size=800,600"):
    options.add_argument(f"--{argument}")
browser = webdriver.Chrome(service=Service(shutil.which("chromedriver")), options=options)
try:
    browser.set_script_timeout(60)
    browser.get(pathlib.Path(sys.argv[1]).resolve().as_uri())
    print(browser.execute_async_script(RUN % sys.stdin.read()))
finally:
    browser.quit()
