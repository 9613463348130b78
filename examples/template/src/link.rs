//! A stand-in for a link (serial, CAN, a fieldbus), which brings the bytes of an image in pieces of its own length.

/// An image in transfer.
pub struct Transfer {
    /// Turn of the machine in which it begins.
    pub turn: u32,
    pub image: &'static [u8],
    /// A byte that the link damages.
    pub damaged: Option<usize>,
}

/// Greatest number of bytes in a piece.
const PIECE: usize = 61;

impl Transfer {
    /// Passes every piece on.
    pub fn pieces<E>(&self, mut receive: impl FnMut(&[u8]) -> Result<(), E>) -> Result<(), E> {
        for (number, piece) in self.image.chunks(PIECE).enumerate() {
            let mut buffer = [0; PIECE];
            let start = number * PIECE;
            for (k, (slot, byte)) in buffer.iter_mut().zip(piece).enumerate() {
                *slot = byte ^ u8::from(self.damaged == Some(start + k));
            }
            receive(buffer.get(..piece.len()).unwrap_or_default())?;
        }
        Ok(())
    }
}
