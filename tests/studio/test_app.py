"""The server: where it may listen, and what it says."""

from __future__ import annotations

import socket

import pytest

from catenaria.errors import InconsistentInputError
from catenaria.studio.app import Address, address, is_loopback


@pytest.mark.parametrize("host", ["127.0.0.1", "127.1.2.3", "::1", "localhost"])
def test_loopback(host: str) -> None:
    assert is_loopback(host)


@pytest.mark.parametrize("host", ["0.0.0.0", "::", "192.168.1.5", "example.org", "localhost.example.org", ""])
def test_anything_else_must_be_exposed(host: str) -> None:
    assert not is_loopback(host)
    with pytest.raises(InconsistentInputError, match="--expose"):
        address(host, 0, expose=False)


def test_a_free_port_is_found() -> None:
    found = address("127.0.0.1", 0, expose=False)
    assert 1024 <= found.port < 65536
    assert found.url == f"http://127.0.0.1:{found.port}"
    assert Address("::1", 80).url == "http://[::1]:80"


def test_a_port_in_use_is_refused() -> None:
    with socket.socket() as taken:
        taken.bind(("127.0.0.1", 0))
        taken.listen()
        with pytest.raises(InconsistentInputError, match="cannot be used"):
            address("127.0.0.1", taken.getsockname()[1], expose=False)


@pytest.mark.parametrize("port", [-1, 65536])
def test_a_port_that_does_not_exist_is_refused(port: int) -> None:
    with pytest.raises(InconsistentInputError, match="cannot be used"):
        address("127.0.0.1", port, expose=False)
