//! TLS for phones and headsets on the local network, which browsers require: a self-signed certificate for each session, identified by its fingerprint.

use crate::failure::Failure;
use graviola::hashing::{Hash, Sha256};
use graviola::signing::ecdsa::{P256, SigningKey};
use rcgen::{CertificateParams, KeyIdMethod, PublicKeyData, SerialNumber, SignatureAlgorithm};
use rustls::pki_types::{PrivateKeyDer, PrivatePkcs8KeyDer};
use rustls::{ServerConfig, ServerConnection, StreamOwned};
use std::io;
use std::net::{SocketAddr, TcpStream};
use std::sync::Arc;

/// Bytes of the longest key or signature.
const ROOM: usize = 256;
/// Bytes of an uncompressed point of the curve, at the end of an encoded public key.
const POINT: usize = 65;

/// The identity of a session.
pub struct Identity {
    config: Arc<ServerConfig>,
    fingerprint: String,
}

impl Identity {
    /// A new key, and a certificate of it for an address.
    ///
    /// # Errors
    /// The processor lacks instructions that the cryptography needs, or there are no random numbers.
    pub fn new(place: SocketAddr) -> Result<Self, Failure> {
        if !graviola::util::is_cpu_supported() {
            return Err(failed("this processor lacks instructions that it needs"));
        }
        let key = Key::new()?;
        let mut params = CertificateParams::new(vec![place.ip().to_string()]).map_err(failed)?;
        let mut serial = [0; 16];
        graviola::random::fill(&mut serial).map_err(|error| failed(format!("{error:?}")))?;
        params.serial_number = Some(SerialNumber::from_slice(&serial));
        params.key_identifier_method = KeyIdMethod::PreSpecified(serial.to_vec());
        let certificate = params.self_signed(&key).map_err(failed)?;
        let digest = Sha256::hash(certificate.der());
        let bytes: Vec<String> = digest.as_ref().iter().map(|byte| format!("{byte:02X}")).collect();
        let private = PrivateKeyDer::Pkcs8(PrivatePkcs8KeyDer::from(key.private));
        let config = ServerConfig::builder_with_provider(Arc::new(rustls_graviola::default_provider()))
            .with_protocol_versions(&[&rustls::version::TLS13])
            .and_then(|builder| {
                builder.with_no_client_auth().with_single_cert(vec![certificate.der().clone()], private)
            })
            .map_err(failed)?;
        Ok(Identity { config: Arc::new(config), fingerprint: bytes.join(":") })
    }

    /// SHA-256 of the certificate, as browsers show it.
    pub fn fingerprint(&self) -> &str {
        &self.fingerprint
    }

    /// Accepts a connection; the TLS handshake happens with the first read.
    ///
    /// # Errors
    /// The configuration is not valid.
    pub fn accept(&self, stream: TcpStream) -> io::Result<StreamOwned<ServerConnection, TcpStream>> {
        let connection = ServerConnection::new(self.config.clone()).map_err(io::Error::other)?;
        Ok(StreamOwned::new(connection, stream))
    }
}

/// A key that signs its own certificate.
struct Key {
    key: SigningKey<P256>,
    private: Vec<u8>,
    public: Vec<u8>,
}

impl Key {
    fn new() -> Result<Self, Failure> {
        let fail = |error: graviola::Error| failed(format!("{error:?}"));
        let key = SigningKey::<P256>::generate().map_err(fail)?;
        let mut room = [0; ROOM];
        let private = key.to_pkcs8_der(&mut room).map_err(fail)?.to_vec();
        let public = key.to_spki_der(&mut room).map_err(fail)?;
        let public = public[public.len() - POINT..].to_vec();
        Ok(Key { key, private, public })
    }
}

impl PublicKeyData for Key {
    fn der_bytes(&self) -> &[u8] {
        &self.public
    }

    fn algorithm(&self) -> &'static SignatureAlgorithm {
        &rcgen::PKCS_ECDSA_P256_SHA256
    }
}

impl rcgen::SigningKey for Key {
    fn sign(&self, message: &[u8]) -> Result<Vec<u8>, rcgen::Error> {
        let mut room = [0; ROOM];
        let signed = self.key.sign_asn1::<Sha256>(&[message], &mut room);
        signed.map(<[u8]>::to_vec).map_err(|_| rcgen::Error::RemoteKeyError)
    }
}

fn failed(error: impl ToString) -> Failure {
    Failure::new(format!("cannot set up TLS for phones: {}", error.to_string()))
}
