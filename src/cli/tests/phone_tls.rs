//! A scripted phone on the network: TLS by the fingerprint that a session prints, the page, and poses that drive an arm.

#![cfg(unix)]

mod command;

use command::{robohive, text};

#[test]
fn an_address_that_is_none_is_named() {
    let out = robohive(&["teleop", "hive/FrankaReach-v0", "--device", "phone-lan:home"]);
    assert!(text(&out.stderr).contains("192.168.0.7"), "{}", text(&out.stderr));
}

#[cfg(not(feature = "tls"))]
#[test]
fn a_build_without_tls_says_what_to_do() {
    let file = command::scratch("no_tls.h5");
    let arguments = ["teleop", "hive/FrankaReach-v0", "--device", "phone-lan:127.0.0.1:0", "--record"];
    let out = robohive(&[&arguments[..], &[file.to_str().unwrap()]].concat());
    let said = text(&out.stderr);
    assert!(
        !out.status.success() && said.contains("--features tls") && said.contains("adb reverse"),
        "{said}"
    );
    assert!(!file.exists(), "nothing is recorded");
}

#[cfg(feature = "tls")]
mod phoning;
#[cfg(feature = "tls")]
mod typing;

#[cfg(feature = "tls")]
mod tls {
    use super::command::scratch;
    use super::phoning::{Page, assert_recorded, status};
    use super::typing::Typed;
    use graviola::hashing::{Hash, Sha256};
    use rustix::termios::{LocalModes, tcgetattr};
    use rustls::client::danger::{HandshakeSignatureValid, ServerCertVerified, ServerCertVerifier};
    use rustls::crypto::{CryptoProvider, verify_tls12_signature, verify_tls13_signature};
    use rustls::pki_types::{CertificateDer, ServerName, UnixTime};
    use rustls::{
        ClientConfig, ClientConnection, DigitallySignedStruct, Error, SignatureScheme, StreamOwned,
    };
    use std::io::{Read, Write};
    use std::net::TcpStream;
    use std::sync::Arc;
    use tungstenite::client;

    /// A browser whose user has compared the fingerprint.
    #[derive(Debug)]
    struct Compared {
        fingerprint: String,
        provider: Arc<CryptoProvider>,
    }

    impl ServerCertVerifier for Compared {
        fn verify_server_cert(
            &self,
            certificate: &CertificateDer<'_>,
            _: &[CertificateDer<'_>],
            _: &ServerName<'_>,
            _: &[u8],
            _: UnixTime,
        ) -> Result<ServerCertVerified, Error> {
            let digest = Sha256::hash(certificate);
            let bytes: Vec<String> = digest.as_ref().iter().map(|byte| format!("{byte:02X}")).collect();
            if bytes.join(":") == self.fingerprint {
                Ok(ServerCertVerified::assertion())
            } else {
                Err(Error::General("another fingerprint".to_owned()))
            }
        }

        fn verify_tls12_signature(
            &self,
            message: &[u8],
            certificate: &CertificateDer<'_>,
            signed: &DigitallySignedStruct,
        ) -> Result<HandshakeSignatureValid, Error> {
            let algorithms = &self.provider.signature_verification_algorithms;
            verify_tls12_signature(message, certificate, signed, algorithms)
        }

        fn verify_tls13_signature(
            &self,
            message: &[u8],
            certificate: &CertificateDer<'_>,
            signed: &DigitallySignedStruct,
        ) -> Result<HandshakeSignatureValid, Error> {
            let algorithms = &self.provider.signature_verification_algorithms;
            verify_tls13_signature(message, certificate, signed, algorithms)
        }

        fn supported_verify_schemes(&self) -> Vec<SignatureScheme> {
            self.provider.signature_verification_algorithms.supported_schemes()
        }
    }

    fn connect(address: &str, fingerprint: &str) -> StreamOwned<ClientConnection, TcpStream> {
        let provider = Arc::new(rustls_graviola::default_provider());
        let compared = Compared { fingerprint: fingerprint.to_owned(), provider: provider.clone() };
        let config = ClientConfig::builder_with_provider(provider)
            .with_safe_default_protocol_versions()
            .unwrap()
            .dangerous()
            .with_custom_certificate_verifier(Arc::new(compared))
            .with_no_client_auth();
        let host = ServerName::try_from("127.0.0.1").unwrap();
        let connection = ClientConnection::new(Arc::new(config), host).unwrap();
        StreamOwned::new(connection, TcpStream::connect(address).unwrap())
    }

    #[test]
    fn a_phone_that_knows_the_fingerprint_drives_behind_tls() {
        let file = scratch("phone_tls.h5");
        let arguments = ["hive/FrankaReach-v0", "--device", "phone-lan:127.0.0.1:0", "--record"];
        let mut typed = Typed::start(&[&arguments[..], &[file.to_str().unwrap()]].concat(), true);
        // A line of the terminal ends where it likes.
        let all: String = typed.all().split_whitespace().collect();
        let (_, after) = all.split_once("openhttps://").unwrap();
        let (place, after) = after.split_once("onthephone").unwrap();
        let (address, key) = place.split_once('/').unwrap();
        let (_, after) = after.split_once("fingerprint").unwrap();
        let fingerprint: String = after.chars().take(32 * 3 - 1).collect();
        let page = format!("/{key}");
        let ask = |fingerprint: &str, path: &str, host: &str| {
            status(&mut connect(address, fingerprint), path, host)
        };
        assert!(ask(&fingerprint, &page, address).unwrap().contains("200"));
        assert!(ask(&fingerprint, "/", address).unwrap().contains("403"));
        assert!(ask(&fingerprint, &page, "evil.example").unwrap().contains("403"));
        assert!(ask(&"00:".repeat(32), &page, address).is_err(), "another certificate is not trusted");
        let mut plain = TcpStream::connect(address).unwrap();
        // At once: the first byte that is not TLS ends the connection.
        let request = format!("GET {page} HTTP/1.1\r\nHost: {address}\r\n\r\n");
        plain.write_all(request.as_bytes()).unwrap();
        let mut answer = Vec::new();
        _ = plain.read_to_end(&mut answer);
        assert!(!String::from_utf8_lossy(&answer).contains("HTTP/1.1"), "nothing is said without TLS");

        let (socket, _) =
            client(format!("wss://{address}/{key}/socket"), connect(address, &fingerprint)).unwrap();
        let mut page = Page::new(socket);
        page.hold("\"RG\"", 60);
        page.hold("\"A\"", 10);
        typed.wait_for("episode 2  seed 1");
        typed.pause();
        assert!(typed.line().starts_with("episode 2"), "{}", typed.line());
        typed.write("\u{1b}[27u");
        let (status, said) = typed.end();
        assert!(status.success() && said.contains("1 episodes kept, 1 succeeded"), "{said}");
        assert!(tcgetattr(&typed.slave).unwrap().local_modes.contains(LocalModes::ICANON));
        assert_recorded(&file);
    }
}
