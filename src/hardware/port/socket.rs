//! Connections and sockets.

use protocol::Port;
use std::io::{self, ErrorKind, Read, Write};
use std::net::{IpAddr, Ipv4Addr, Ipv6Addr, SocketAddr, TcpStream, ToSocketAddrs, UdpSocket};
use std::time::{Duration, Instant};

/// Longest wait for a connection.
const CONNECT: Duration = Duration::from_secs(2);
/// Sleep between two looks for something to receive.
const NAP: Duration = Duration::from_micros(100);
/// Datagrams of other hosts that are skipped in one look: those of the device are queued behind them, and grow old.
const FOREIGN: usize = 1024;

/// Opens connections and sockets.
pub trait Sockets: Send + Sync {
    /// Connects to a server.
    ///
    /// # Errors
    /// Nobody answers there, or a refusal.
    fn connect(&self, host: &str, port: u16) -> io::Result<Box<dyn Port>>;

    /// A socket for datagrams from the device whose server has this port, and the port that it has itself. It takes nothing
    /// from other machines, and sends to where the last datagram came from.
    ///
    /// # Errors
    /// The system has none to give.
    fn datagrams(&self, host: &str, server: u16) -> io::Result<(Box<dyn Port>, u16)>;

    /// A socket at a port of this machine, for datagrams that `host` sends there, or to a multicast group.
    ///
    /// # Errors
    /// The port is taken; the group cannot be joined.
    fn listen(&self, host: &str, port: u16, group: Option<Ipv4Addr>) -> io::Result<Box<dyn Port>>;
}

/// The network of this machine.
#[derive(Clone, Copy, Debug, Default)]
pub struct Network;

/// Where simulated devices are, but none behind a network.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct NoNetwork;

impl NoNetwork {
    fn refuse<T>(host: &str) -> io::Result<T> {
        Err(io::Error::new(ErrorKind::NotFound, format!("no simulated device is at {host}")))
    }
}

impl Sockets for NoNetwork {
    fn connect(&self, host: &str, _port: u16) -> io::Result<Box<dyn Port>> {
        NoNetwork::refuse(host)
    }

    fn datagrams(&self, host: &str, _server: u16) -> io::Result<(Box<dyn Port>, u16)> {
        NoNetwork::refuse(host)
    }

    fn listen(&self, host: &str, _port: u16, _group: Option<Ipv4Addr>) -> io::Result<Box<dyn Port>> {
        NoNetwork::refuse(host)
    }
}

fn resolve(host: &str, port: u16) -> io::Result<SocketAddr> {
    let mut addresses = (host, port).to_socket_addrs()?;
    addresses.next().ok_or_else(|| io::Error::new(ErrorKind::NotFound, format!("'{host}' has no address")))
}

impl Sockets for Network {
    fn connect(&self, host: &str, port: u16) -> io::Result<Box<dyn Port>> {
        let stream = TcpStream::connect_timeout(&resolve(host, port)?, CONNECT)?;
        stream.set_nodelay(true)?;
        stream.set_nonblocking(true)?;
        Ok(Box::new(Connection { stream, start: Instant::now() }))
    }

    fn datagrams(&self, host: &str, server: u16) -> io::Result<(Box<dyn Port>, u16)> {
        let peer = resolve(host, server)?.ip();
        let any = match peer {
            IpAddr::V4(_) => IpAddr::V4(Ipv4Addr::UNSPECIFIED),
            IpAddr::V6(_) => IpAddr::V6(Ipv6Addr::UNSPECIFIED),
        };
        let socket = UdpSocket::bind((any, 0))?;
        socket.set_nonblocking(true)?;
        let port = socket.local_addr()?.port();
        let last = Some(SocketAddr::new(peer, server));
        Ok((Box::new(Datagrams { socket, peer, last, start: Instant::now() }), port))
    }

    fn listen(&self, host: &str, port: u16, group: Option<Ipv4Addr>) -> io::Result<Box<dyn Port>> {
        let peer = resolve(host, port)?.ip();
        let taken = format!("UDP port {port}");
        let socket = UdpSocket::bind((Ipv4Addr::UNSPECIFIED, port)).map_err(explain(&taken))?;
        if let Some(group) = group {
            socket.join_multicast_v4(&group, &Ipv4Addr::UNSPECIFIED).map_err(explain("joining the group"))?;
        }
        socket.set_nonblocking(true)?;
        Ok(Box::new(Datagrams { socket, peer, last: None, start: Instant::now() }))
    }
}

fn explain(what: &str) -> impl Fn(io::Error) -> io::Error + '_ {
    move |error| io::Error::new(error.kind(), format!("{what}: {error}"))
}

/// Looks again and again until something is there, it is too late, or nobody is there any more.
fn poll(timeout: f64, mut look: impl FnMut() -> io::Result<usize>) -> io::Result<usize> {
    let end = Instant::now() + Duration::try_from_secs_f64(timeout).unwrap_or_default();
    loop {
        match look() {
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::Interrupted) => {
                let left = end.saturating_duration_since(Instant::now());
                if left.is_zero() {
                    return Ok(0);
                }
                std::thread::sleep(left.min(NAP));
            }
            outcome => return outcome,
        }
    }
}

fn discard(mut receive: impl FnMut() -> io::Result<usize>) -> io::Result<()> {
    while receive()? > 0 {}
    Ok(())
}

/// A connection that has gone reports it in several ways.
fn gone(error: io::Error) -> io::Error {
    match error.kind() {
        ErrorKind::BrokenPipe
        | ErrorKind::NotConnected
        | ErrorKind::ConnectionReset
        | ErrorKind::ConnectionAborted => closed(),
        _ => error,
    }
}

fn closed() -> io::Error {
    io::Error::new(ErrorKind::UnexpectedEof, "the device closed the connection")
}

struct Connection {
    stream: TcpStream,
    start: Instant,
}

impl Port for Connection {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        // Requests are far shorter than what the system takes at once.
        self.stream.write_all(bytes).map_err(gone)
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
        let stream = &mut self.stream;
        poll(timeout, || match stream.read(buffer) {
            Ok(0) => Err(closed()),
            other => other.map_err(gone),
        })
    }

    fn discard(&mut self) -> io::Result<()> {
        discard(|| self.receive(&mut [0; 1024], 0.0))
    }

    fn now(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn wait(&mut self, seconds: f64) {
        std::thread::sleep(Duration::try_from_secs_f64(seconds).unwrap_or_default());
    }
}

struct Datagrams {
    socket: UdpSocket,
    peer: IpAddr,
    /// Where the last came from.
    last: Option<SocketAddr>,
    start: Instant,
}

impl Port for Datagrams {
    fn send(&mut self, bytes: &[u8]) -> io::Result<()> {
        let Some(last) = self.last else { return Ok(()) };
        match self.socket.send_to(bytes, last) {
            Ok(_) => Ok(()),
            // It is lost, as on the way.
            Err(error) if matches!(error.kind(), ErrorKind::WouldBlock | ErrorKind::ConnectionRefused) => {
                Ok(())
            }
            Err(error) => Err(error),
        }
    }

    fn receive(&mut self, buffer: &mut [u8], timeout: f64) -> io::Result<usize> {
        let Datagrams { socket, peer, last, .. } = self;
        poll(timeout, || {
            for _ in 0..FOREIGN {
                match socket.recv_from(buffer) {
                    Ok((_, from)) if from.ip() != *peer => {}
                    Ok((count, from)) => {
                        *last = Some(from);
                        return Ok(count);
                    }
                    // Nobody listens where a command went; the next state tells more.
                    Err(error)
                        if matches!(
                            error.kind(),
                            ErrorKind::ConnectionRefused | ErrorKind::ConnectionReset
                        ) => {}
                    Err(error) => return Err(error),
                }
            }
            Err(ErrorKind::WouldBlock.into())
        })
    }

    fn discard(&mut self) -> io::Result<()> {
        discard(|| self.receive(&mut [0; 4096], 0.0))
    }

    fn now(&self) -> f64 {
        self.start.elapsed().as_secs_f64()
    }

    fn wait(&mut self, seconds: f64) {
        std::thread::sleep(Duration::try_from_secs_f64(seconds).unwrap_or_default());
    }
}

#[cfg(all(test, target_os = "linux"))]
mod tests {
    use super::*;

    #[test]
    fn datagrams_of_others_do_not_stand_before_those_of_the_device() {
        let (mut port, number) = Network.datagrams("127.0.0.1", 9).unwrap();
        let ours = (Ipv4Addr::LOCALHOST, number);
        let [device, other] = ["127.0.0.1:0", "127.0.0.2:0"].map(|address| UdpSocket::bind(address).unwrap());
        for _ in 0..20 {
            other.send_to(b"other", ours).unwrap();
        }
        device.send_to(b"state", ours).unwrap();
        let mut buffer = [0; 16];
        // One look, without waiting.
        assert_eq!(port.receive(&mut buffer, 0.0).unwrap(), 5);
        assert_eq!(&buffer[..5], b"state");
        other.send_to(b"other", ours).unwrap();
        device.send_to(b"state", ours).unwrap();
        port.discard().unwrap();
        assert_eq!(port.receive(&mut buffer, 0.0).unwrap(), 0);
    }
}
