"""An S3 server of our own on the loopback, which writes down what it is asked."""

import logging
import threading
import urllib.request
from collections.abc import Iterator
from dataclasses import dataclass, field

import pytest
from moto.server import DomainDispatcherApplication, create_backend_app
from werkzeug.serving import make_server

from artgen.core.jsonio import content_hash


@dataclass
class Bucket:
    """A fresh bucket, and the requests for its objects: (method, key, range or "")."""

    url: str
    requests: list[tuple[str, str, str]] = field(default_factory=list)


@pytest.fixture(scope="session")
def s3_server() -> Iterator[tuple[str, list[tuple[str, str, str]]]]:
    """Endpoint and request log of moto's server."""
    logging.getLogger("werkzeug").setLevel(logging.ERROR)
    moto = DomainDispatcherApplication(create_backend_app)
    log: list[tuple[str, str, str]] = []

    def recorded(environ, start_response):
        log.append((environ["REQUEST_METHOD"], environ["PATH_INFO"], environ.get("HTTP_RANGE", "")))
        return moto(environ, start_response)

    server = make_server("127.0.0.1", 0, recorded, threaded=True)
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()
    yield f"http://127.0.0.1:{server.server_port}", log
    server.shutdown()
    thread.join()


@pytest.fixture
def bucket(s3_server, request, monkeypatch) -> Bucket:
    """A bucket named for the test, with the environment that leads to it."""
    endpoint, log = s3_server
    name = f"b{content_hash(request.node.nodeid)[:16]}"
    for key, value in {
        "AWS_ENDPOINT_URL": endpoint,
        "AWS_ALLOW_HTTP": "true",
        "AWS_REGION": "us-east-1",
        "AWS_ACCESS_KEY_ID": "key",
        "AWS_SECRET_ACCESS_KEY": "secret",
    }.items():
        monkeypatch.setenv(key, value)
    made = urllib.request.Request(f"{endpoint}/{name}", method="PUT")
    urllib.request.urlopen(made).close()
    log.clear()
    return Bucket(url=f"s3://{name}", requests=log)
